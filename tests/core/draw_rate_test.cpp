// SPDX-License-Identifier: Apache-2.0
// A bound on drawing in milliseconds: what is learnt from frames that were measured, and what the planner makes of it.
#include "avenue.h"

#include <gnomon/draw_rate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(DrawRate, IsTheMeanOfWhatWasMeasured)
{
    DrawRate rate;
    EXPECT_EQ(rate.msPerTexel(), 0.0);
    rate.take(1000, 2.0);
    EXPECT_DOUBLE_EQ(rate.msPerTexel(), 0.002);
    rate.take(3000, 3.0); // a large frame counts for more
    const double kept = std::exp2(-1.0 / 8.0);
    EXPECT_NEAR(rate.msPerTexel(), (kept * 2.0 + 3.0) / (kept * 1000.0 + 3000.0), 1e-12);
    for (int i = 0; i < 100; ++i) {
        rate.take(2000, 2000 * 0.0007);
    }
    EXPECT_NEAR(rate.msPerTexel(), 0.0007, 1e-7);
}

TEST(DrawRate, TakesNothingFromFramesThatTellNothing)
{
    DrawRate rate;
    for (const double ms : {0.0, -1.0, kNaN, kInfinity, -kInfinity}) {
        rate.take(1000, ms);
        EXPECT_EQ(rate.msPerTexel(), 0.0);
    }
    rate.take(0, 5.0);
    EXPECT_EQ(rate.msPerTexel(), 0.0);
    rate.take(1000, 1.0);
    rate.take(1000, kNaN);
    rate.take(0, 100.0);
    EXPECT_DOUBLE_EQ(rate.msPerTexel(), 0.001);
    rate.forget();
    EXPECT_EQ(rate.msPerTexel(), 0.0);
}

TEST(DrawRate, StandsAHiccupAndFollowsAChange)
{
    DrawRate rate;
    for (int i = 0; i < 30; ++i) {
        rate.take(1000, 1.0);
    }
    rate.take(1000, 1000.0); // the thousandfold, once
    EXPECT_LT(rate.msPerTexel(), 0.0014);
    for (int i = 0; i < 30; ++i) {
        rate.take(1000, 1.0);
    }
    EXPECT_NEAR(rate.msPerTexel(), 0.001, 0.00005);
    int frames = 0;
    for (; rate.msPerTexel() < 0.012; ++frames) {
        ASSERT_LT(frames, 100);
        rate.take(1000, 16.0);
    }
    EXPECT_GT(frames, 2);
    EXPECT_LT(frames, 20);
    rate.take(std::numeric_limits<std::uint64_t>::max(), 1e300);
    EXPECT_TRUE(std::isfinite(rate.msPerTexel()));
}

/// Plans 20 frames of a walk with 24 lamps; returns the most texels that one after the first draws.
std::uint64_t mostDrawn(const ShadowOptions& bounds, double ms_per_texel, std::uint32_t& longest)
{
    test::Avenue avenue(24);
    avenue.options.draw_budget_texels = bounds.draw_budget_texels;
    avenue.options.draw_budget_ms = bounds.draw_budget_ms;
    avenue.options.longest_wait = bounds.longest_wait;
    avenue.frame.draw_ms_per_texel = ms_per_texel;
    Planner planner(avenue.options);
    std::uint64_t most = 0;
    longest = 0;
    for (int step = 0; step < 20; ++step) {
        avenue.walk(step);
        const Plan& plan = planner.plan(avenue.frame);
        most = step > 0 ? std::max(most, test::drawnTexels(plan)) : most;
        longest = std::max(longest, test::longestWait(plan));
    }
    return most;
}

TEST(DrawRate, BoundsWhatAFrameDraws)
{
    constexpr std::uint64_t kLamp = 6 * 64 * 64;
    std::uint32_t longest = 0;
    const std::uint64_t all = mostDrawn({}, 1e-5, longest);
    ASSERT_GT(all, 8 * kLamp);
    EXPECT_EQ(longest, 0U) << "the rate alone bounds nothing";
    // 1 ms at 1e-5 ms a texel is 100,000 of them: four lamps.
    EXPECT_LE(mostDrawn({.draw_budget_ms = 1.0, .longest_wait = 64}, 1e-5, longest), 100000U);
    EXPECT_GT(longest, 0U);
    EXPECT_LE(mostDrawn({.draw_budget_ms = 0.5, .longest_wait = 64}, 1e-5, longest), 50000U);
    // The tighter one of two bounds holds.
    EXPECT_LE(mostDrawn({.draw_budget_texels = 50000, .draw_budget_ms = 1.0, .longest_wait = 64}, 1e-5, longest),
              50000U);
    EXPECT_LE(mostDrawn({.draw_budget_texels = 100000, .draw_budget_ms = 0.5, .longest_wait = 64}, 1e-5, longest),
              50000U);
}

TEST(DrawRate, BoundsNothingWhereItIsNotKnownAndStarvesNobody)
{
    std::uint32_t longest = 0;
    const std::uint64_t all = mostDrawn({}, 0.0, longest);
    for (const double unknown : {0.0, -1.0, kNaN, kInfinity, 1e-300, std::numeric_limits<double>::denorm_min()}) {
        EXPECT_EQ(mostDrawn({.draw_budget_ms = 1e-3}, unknown, longest), all) << unknown;
        EXPECT_EQ(longest, 0U);
    }
    // So slow that there is time for nothing: one lamp a frame, and who has waited for long enough.
    (void)mostDrawn({.draw_budget_ms = 1.0, .longest_wait = 3}, 1e300, longest);
    EXPECT_EQ(longest, 3U);
    EXPECT_LE(mostDrawn({.draw_budget_ms = 1.0, .longest_wait = 64}, 1e300, longest), std::uint64_t{6 * 64 * 64});
}

} // namespace
} // namespace gnomon
