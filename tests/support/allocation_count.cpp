// SPDX-License-Identifier: Apache-2.0
// In a file of its own, so that no caller sees malloc behind new and complains of the mismatch. Every form is replaced
// that the standard library uses: std::stable_sort takes its buffer by the one that must not throw.
#include "allocation_count.h"

#include <cstdlib>
#include <new>

namespace {

thread_local std::uint64_t t_count = 0;

void* allocate(std::size_t size) noexcept
{
    ++t_count;
    return std::malloc(size == 0 ? 1 : size);
}

void* allocateOrThrow(std::size_t size)
{
    if (void* memory = allocate(size)) {
        return memory;
    }
    throw std::bad_alloc();
}

} // namespace

std::uint64_t gnomon::test::heapAllocations()
{
    return t_count;
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
void operator delete(void* memory, const std::nothrow_t&) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept
{
    std::free(memory);
}
