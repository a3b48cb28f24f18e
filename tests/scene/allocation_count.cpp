// SPDX-License-Identifier: Apache-2.0
#include "allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> count{0};
}

std::size_t allocationCount()
{
    return count.load();
}

void* operator new(std::size_t size)
{
    count.fetch_add(1);
    if (void* memory = std::malloc(size == 0 ? 1 : size)) {
        return memory;
    }
    throw std::bad_alloc();
}

// std::stable_sort asks this one; left out, a sanitizer would see its memory freed by the wrong hand.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    count.fetch_add(1);
    return std::malloc(size == 0 ? 1 : size);
}

void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept
{
    std::free(memory);
}
