// SPDX-License-Identifier: Apache-2.0
// Threads that cannot be had, for want of memory, are done without.
#include "parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

namespace {

constexpr int kUnlimited = -1;
/// How many more times this thread may take memory.
thread_local int allocations_left = kUnlimited;

} // namespace

// Of the whole test program, so that the standard library's own requests can fail. All forms that one `delete` serves:
// a sanitizer has its own of each, and minds a mixture.
// Never inlined: where GCC 12 sees through one of them only, it believes new and free to be mixed.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept
{
    if (allocations_left == 0) {
        return nullptr;
    }
    if (allocations_left > 0) {
        --allocations_left;
    }
    return std::malloc(std::max<std::size_t>(bytes, 1));
}
[[gnu::noinline]] void* operator new(std::size_t bytes)
{
    if (void* memory = operator new(bytes, std::nothrow)) {
        return memory;
    }
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept
{
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*bytes*/) noexcept
{
    std::free(memory);
}

namespace gnomon::truth::test {
namespace {

TEST(Tiles, are_all_done_by_fewer_threads_when_memory_for_threads_runs_out)
{
    constexpr glm::uvec2 kSize(100, 60);
    int refused = 0;
    int done = 0;
    for (int allowed = 0; allowed < 8; ++allowed) {
        std::vector<std::atomic<int>> visits(std::size_t{kSize.x} * kSize.y);
        const std::function<void(const Tile&)> work = [&](const Tile& tile) {
            for (std::uint32_t y = tile.min.y; y < tile.max.y; ++y) {
                for (std::uint32_t x = tile.min.x; x < tile.max.x; ++x) {
                    ++visits[std::size_t{y} * kSize.x + x];
                }
            }
        };
        const Options options{.threads = 4};
        allocations_left = allowed;
        try {
            const bool finished = forEachTile(kSize, options, work);
            allocations_left = kUnlimited;
            EXPECT_TRUE(finished);
            EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; })) << allowed;
            ++done;
        } catch (const std::bad_alloc&) {
            allocations_left = kUnlimited;
            ++refused;
        }
    }
    EXPECT_GE(done, 7); // from the second on: the first is the list of threads
    EXPECT_GE(refused, 1);
}

} // namespace
} // namespace gnomon::truth::test
