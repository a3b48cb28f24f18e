// SPDX-License-Identifier: Apache-2.0
// Counts allocations through operator new, and measures how much is held at once. A test binary that links
// gnomon_allocation_count has its operators replaced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::test {

/// Allocations of this thread since it began.
[[nodiscard]] std::uint64_t heapAllocations();
/// Bytes that this thread has taken and not given back. Bytes that another thread gives back still count.
[[nodiscard]] std::ptrdiff_t heapHeld();
/// The most bytes that `work` held at one time in this thread, beyond what was held before.
[[nodiscard]] std::size_t heapPeakDuring(const std::function<void()>& work);

/// While it lives, no allocation of this thread fails; for calls into other libraries.
class SpareHeap {
public:
    SpareHeap();
    ~SpareHeap();
    SpareHeap(const SpareHeap&) = delete;
    SpareHeap& operator=(const SpareHeap&) = delete;
};

/// Lets one allocation of this thread, or of all threads, fail: the n-th after its construction, counted from 1
/// (std::bad_alloc, or null from nothrow new). There may be one at a time.
class FailingAllocation {
public:
    enum class Of : std::uint8_t { this_thread, all_threads };
    explicit FailingAllocation(std::uint64_t nth, Of whose = Of::this_thread);
    ~FailingAllocation();
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;
    /// Did an allocation fail?
    [[nodiscard]] static bool failed();
    /// Allocations since its construction, up to the one that failed.
    [[nodiscard]] std::uint64_t asked() const;

private:
    std::uint64_t nth_;
    Of whose_;
};

} // namespace gnomon::test
