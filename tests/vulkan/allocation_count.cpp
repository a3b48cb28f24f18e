// SPDX-License-Identifier: Apache-2.0
#include "allocation_count.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::uint64_t count = 0;

void* allocate(std::size_t size)
{
    ++count;
    if (void* memory = std::malloc(size != 0 ? size : 1)) {
        return memory;
    }
    throw std::bad_alloc();
}
} // namespace

std::uint64_t gnomon::test::heapAllocations()
{
    return count;
}

void* operator new(std::size_t size)
{
    return allocate(size);
}
void* operator new[](std::size_t size)
{
    return allocate(size);
}
// std::stable_sort asks this one; left out, a sanitizer would see its memory freed by the wrong hand.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    ++count;
    return std::malloc(size != 0 ? size : 1);
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
    std::free(memory);
}
