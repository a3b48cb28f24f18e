// SPDX-License-Identifier: Apache-2.0
// In a file of its own, so that no caller sees malloc behind new and complains of the mismatch. Every form is replaced
// that the standard library uses: std::stable_sort takes its buffer by the one that must not throw.
#include "allocation_count.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

thread_local std::uint64_t t_count = 0;
thread_local std::ptrdiff_t t_held = 0; // bytes
thread_local std::ptrdiff_t t_peak = 0;

// How many allocations it is to the one that fails; 0: none does.
thread_local std::uint64_t t_until_failure = 0;
thread_local int t_spared = 0; // SpareHeaps that live
std::atomic<std::uint64_t> until_failure_of_all{0};
std::atomic<bool> has_failed{false};

bool fails() noexcept
{
    if (t_spared != 0) {
        return false;
    }
    bool now = t_until_failure != 0 && --t_until_failure == 0;
    // Hardly ever anything else, so that counting costs no more than a look.
    if (std::uint64_t left = until_failure_of_all.load(std::memory_order_relaxed); left != 0) {
        while (left != 0 && !until_failure_of_all.compare_exchange_weak(left, left - 1)) {
        }
        now = now || left == 1;
    }
    if (now) {
        has_failed = true;
    }
    return now;
}

void* allocate(std::size_t size) noexcept
{
    if (fails()) {
        return nullptr;
    }
    ++t_count;
    void* memory = std::malloc(size == 0 ? 1 : size);
    t_held += static_cast<std::ptrdiff_t>(malloc_usable_size(memory));
    t_peak = std::max(t_peak, t_held);
    return memory;
}

void* allocateOrThrow(std::size_t size)
{
    if (void* memory = allocate(size)) {
        return memory;
    }
    throw std::bad_alloc();
}

void release(void* memory) noexcept
{
    t_held -= static_cast<std::ptrdiff_t>(malloc_usable_size(memory));
    std::free(memory);
}

} // namespace

std::uint64_t gnomon::test::heapAllocations()
{
    return t_count;
}

std::ptrdiff_t gnomon::test::heapHeld()
{
    return t_held;
}

std::size_t gnomon::test::heapPeakDuring(const std::function<void()>& work)
{
    const std::ptrdiff_t before = t_held;
    t_peak = t_held;
    work();
    return static_cast<std::size_t>(t_peak - before);
}

gnomon::test::SpareHeap::SpareHeap()
{
    ++t_spared;
}

gnomon::test::SpareHeap::~SpareHeap()
{
    --t_spared;
}

gnomon::test::FailingAllocation::FailingAllocation(std::uint64_t nth, Of whose) : nth_(nth), whose_(whose)
{
    has_failed = false;
    t_until_failure = whose == Of::this_thread ? nth : 0;
    until_failure_of_all = whose == Of::all_threads ? nth : 0;
}

gnomon::test::FailingAllocation::~FailingAllocation()
{
    t_until_failure = 0;
    until_failure_of_all = 0;
}

bool gnomon::test::FailingAllocation::failed()
{
    return has_failed;
}

std::uint64_t gnomon::test::FailingAllocation::asked() const
{
    return nth_ - (whose_ == Of::this_thread ? t_until_failure : until_failure_of_all.load());
}

void* operator new(std::size_t size)
{
    return allocateOrThrow(size);
}
void* operator new[](std::size_t size)
{
    return allocateOrThrow(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
    return allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept
{
    return allocate(size);
}
void operator delete(void* memory) noexcept
{
    release(memory);
}
void operator delete[](void* memory) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
    release(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept
{
    release(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept
{
    release(memory);
}
