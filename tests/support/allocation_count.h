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
/// Bytes that this thread has taken and not given back. What another thread gives back is not known here.
[[nodiscard]] std::ptrdiff_t heapHeld();
/// The most bytes that `work` held at one time in this thread, beyond what was held before.
[[nodiscard]] std::size_t heapPeakDuring(const std::function<void()>& work);

/// For as long as it lives, what this thread takes does not fail: for the inside of a library that is not ours.
class SpareHeap {
public:
    SpareHeap();
    ~SpareHeap();
    SpareHeap(const SpareHeap&) = delete;
    SpareHeap& operator=(const SpareHeap&) = delete;
};

/// Heap of this thread, or of all threads, that runs out at one moment: the n-th allocation from its making on, counted
/// from 1, fails (std::bad_alloc, or null where that is asked for), and none after it. One at a time.
class FailingAllocation {
public:
    enum class Of : std::uint8_t { this_thread, all_threads };
    explicit FailingAllocation(std::uint64_t nth, Of whose = Of::this_thread);
    ~FailingAllocation();
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;
    /// Did it come to that?
    [[nodiscard]] static bool failed();
    /// Allocations since its making, up to the one that failed.
    [[nodiscard]] std::uint64_t asked() const;

private:
    std::uint64_t nth_;
    Of whose_;
};

} // namespace gnomon::test
