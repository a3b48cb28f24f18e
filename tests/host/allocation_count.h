// SPDX-License-Identifier: Apache-2.0
// Counts what this thread takes from the heap through operator new.
#pragma once

#include <cstddef>

namespace gnomon::host::test {

void startCounting();
[[nodiscard]] std::size_t stopCounting(); // since startCounting()

} // namespace gnomon::host::test
