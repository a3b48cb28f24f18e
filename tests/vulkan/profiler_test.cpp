// SPDX-License-Identifier: Apache-2.0
// The profiler's results on devices that lack some parts.
#include "null_driver.h"

#include <gnomon/vulkan/profiler.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon::test {
namespace {

using vulkan::PassRecord;
using Kind = NullEvent::Kind;

struct Measured {
    PassRecord pass;
    std::size_t timestamps = 0; // commands
    std::size_t queries = 0;
};

Measured measureOn(const NullLimits& limits, bool statistics)
{
    NullDriver driver(limits);
    vulkan::DeviceView view = driver.view();
    view.features.statistics = statistics;
    vulkan::Profiler profiler(view, 1, 4);
    profiler.beginFrame(driver.commands(), 0);
    profiler.beginPass(driver.commands(), "mask");
    profiler.addDraws(3);
    profiler.endPass(driver.commands());
    const auto count = [&](Kind kind) {
        return static_cast<std::size_t>(std::ranges::count(driver.events(), kind, &NullEvent::kind));
    };
    return {profiler.results(0)[0], count(Kind::timestamp), count(Kind::begin_query)};
}

TEST(Profiler, LeavesOutTimesWithoutTimestamps)
{
    const Measured measured = measureOn({.timestamp_bits = 0}, true);
    EXPECT_FALSE(measured.pass.milliseconds.has_value());
    EXPECT_TRUE(measured.pass.has_statistics);
    EXPECT_EQ(measured.pass.draws, 3U);
    EXPECT_EQ(measured.timestamps, 0U);
    EXPECT_EQ(measured.queries, 1U);
}

TEST(Profiler, LeavesOutCountsWithoutStatistics)
{
    const Measured measured = measureOn({}, false);
    EXPECT_TRUE(measured.pass.milliseconds.has_value());
    EXPECT_FALSE(measured.pass.has_statistics);
    EXPECT_EQ(measured.pass.draws, 3U);
    EXPECT_EQ(measured.timestamps, 2U);
    EXPECT_EQ(measured.queries, 0U);
}

TEST(Profiler, LeavesOutAllForAFamilyThatThereIsNot)
{
    NullDriver driver;
    vulkan::DeviceView view = driver.view();
    view.queue_family = 7;
    vulkan::Profiler profiler(view, 1, 1);
    profiler.beginFrame(driver.commands(), 0);
    profiler.beginPass(driver.commands(), "mask");
    profiler.endPass(driver.commands());
    EXPECT_FALSE(profiler.results(0)[0].milliseconds.has_value());
}

// A tick is a nanosecond. The specification allows 36 bits, above which bits are undefined.
TEST(Profiler, TakesTheBitsThatAreValidAndAClockThatWraps)
{
    constexpr std::uint64_t kAbove = 0xABCULL << 36U;
    constexpr std::array<std::uint64_t, 2> kPlain{1'000'000, kAbove + 3'000'000};
    EXPECT_DOUBLE_EQ(*measureOn({.timestamp_bits = 36, .query_results = kPlain}, false).pass.milliseconds, 2.0);
    constexpr std::array<std::uint64_t, 2> kWrapped{(1ULL << 36U) - 500'000, 500'000};
    EXPECT_DOUBLE_EQ(*measureOn({.timestamp_bits = 36, .query_results = kWrapped}, false).pass.milliseconds, 1.0);
    constexpr std::array<std::uint64_t, 2> kWhole{~0ULL - 999'999, 1'000'000};
    EXPECT_DOUBLE_EQ(*measureOn({.timestamp_bits = 64, .query_results = kWhole}, false).pass.milliseconds, 2.0);
}

} // namespace
} // namespace gnomon::test
