// SPDX-License-Identifier: Apache-2.0
// How many times this thread asked the heap for memory.
#pragma once

#include <cstdint>

namespace gnomon::test {

[[nodiscard]] std::uint64_t heapAllocations();

} // namespace gnomon::test
