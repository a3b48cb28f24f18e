// SPDX-License-Identifier: Apache-2.0
// Counts what is taken from the heap through operator new, and measures how much is held at once. A test binary that
// links gnomon_allocation_count has its operators replaced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::test {

/// Allocations of this thread since it began.
[[nodiscard]] std::uint64_t heapAllocations();
/// The most bytes that `work` held at one time in this thread, beyond what was held before.
[[nodiscard]] std::size_t heapPeakDuring(const std::function<void()>& work);

} // namespace gnomon::test
