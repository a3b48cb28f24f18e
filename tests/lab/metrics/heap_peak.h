// SPDX-License-Identifier: Apache-2.0
// How much a piece of code takes from the heap at once, through operator new, which this test binary has replaced.
#pragma once

#include <cstddef>
#include <functional>

namespace gnomon::lab::test {

/// The most bytes that `work` held at one time in this thread, beyond what was held before.
[[nodiscard]] std::size_t heapPeakDuring(const std::function<void()>& work);

} // namespace gnomon::lab::test
