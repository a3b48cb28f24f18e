// SPDX-License-Identifier: Apache-2.0
// Threads that cannot be had are done without.
#include "parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

namespace {

constexpr int kUnlimited = -1;
/// How many more times this thread may take memory.
thread_local int allocations_left = kUnlimited;

} // namespace

// Operators of the whole test program, so that the standard library's own requests can fail. They are all forms that
// one `delete` serves: a sanitizer has its own of each, and refuses a mixture. Never inlined: where GCC 12 sees through
// only one of them, it warns that new and free are mixed.
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
    for (int allowed = 0; allowed < 8; ++allowed) {
        std::vector<std::atomic<int>> visits(std::size_t{kSize.x} * kSize.y);
        std::atomic<bool> helped{false};
        const std::function<void(const Tile&)> work = [&, caller = std::this_thread::get_id()](const Tile& tile) {
            helped = helped || std::this_thread::get_id() != caller;
            for (std::uint32_t y = tile.min.y; y < tile.max.y; ++y) {
                for (std::uint32_t x = tile.min.x; x < tile.max.x; ++x) {
                    ++visits[std::size_t{y} * kSize.x + x];
                }
            }
        };
        const Options options{.threads = 4};
        allocations_left = allowed;
        const bool finished = forEachTile(kSize, options, work);
        const bool ran_out = allocations_left == 0;
        allocations_left = kUnlimited;
        EXPECT_TRUE(finished);
        EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; })) << allowed;
        EXPECT_TRUE(allowed > 0 || (ran_out && !helped));
    }
}

} // namespace
} // namespace gnomon::truth::test
