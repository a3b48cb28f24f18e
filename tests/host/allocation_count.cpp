// SPDX-License-Identifier: Apache-2.0
// In a file of its own, so that no caller sees malloc behind new and complains of the mismatch.
#include "allocation_count.h"

#include <cstdlib>
#include <new>

namespace {
thread_local bool t_counting = false;
thread_local std::size_t t_count = 0;
} // namespace

void* operator new(std::size_t size)
{
    t_count += t_counting ? 1 : 0;
    if (void* p = std::malloc(size == 0 ? 1 : size)) {
        return p;
    }
    throw std::bad_alloc();
}

// The library's temporary buffers come from this one, and must go back the way they came.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
    t_count += t_counting ? 1 : 0;
    return std::malloc(size == 0 ? 1 : size);
}

void operator delete(void* p) noexcept
{
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept
{
    std::free(p);
}

namespace gnomon::host::test {

void startCounting()
{
    t_count = 0;
    t_counting = true;
}

std::size_t stopCounting()
{
    t_counting = false;
    return t_count;
}

} // namespace gnomon::host::test
