// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include <gnomon/shared/sun_steps.h>

#include <gtest/gtest.h>

namespace gnomon::shared {
namespace {

TEST(SunSteps, withoutABandTheShareCountsEverywhere)
{
    for (const double x : {0.0, 0.3, 1.0}) {
        EXPECT_EQ(stepWeight({0.25, 0.5, 0.0, 0.0}, x), 0.25);
        EXPECT_DOUBLE_EQ(stepWeight({0.25, 0.5, 0.0, 1.0}, x), 0.25 * 0.25 * (3.0 - 0.5));
    }
    for (const double smooth : {0.0, 1.0}) {
        EXPECT_EQ(stepWeight({0.0, 0.0, 0.0, smooth}, 0.5), 0.0);
        EXPECT_EQ(stepWeight({0.5, 0.0, 0.0, smooth}, 0.5), 0.5);
        EXPECT_EQ(stepWeight({1.0, 0.0, 0.0, smooth}, 0.5), 1.0);
    }
}

TEST(SunSteps, aBandLeadsFromTheLaterPositionToTheEarlierOne)
{
    const real4 steps(0.9, 0.6, 1.0 / 0.25, 0.0); // the share does not count
    EXPECT_EQ(stepWeight(steps, 0.0), 1.0);
    EXPECT_EQ(stepWeight(steps, 0.34), 1.0);
    EXPECT_DOUBLE_EQ(stepWeight(steps, 0.475), 0.5);
    EXPECT_EQ(stepWeight(steps, 0.61), 0.0);
    EXPECT_EQ(stepWeight(steps, 1.0), 0.0);
    double before = 2.0;
    for (double x = 0.36; x < 0.59; x += 0.01) {
        const double smooth = stepWeight({0.9, 0.6, 4.0, 1.0}, x);
        EXPECT_LT(smooth, before);
        before = smooth;
    }
}

TEST(SunSteps, visibilitiesMeetAtTheirEnds)
{
    EXPECT_EQ(steppedVisibility(0.2, 0.9, 0.0), 0.2);
    EXPECT_DOUBLE_EQ(steppedVisibility(0.2, 0.9, 1.0), 0.9);
    EXPECT_DOUBLE_EQ(steppedVisibility(0.2, 0.9, 0.5), 0.55);
}

// Whichever position this frame has, both give what they would give together.
TEST(SunSteps, turnsGiveWhatBothAtOnceGive)
{
    for (const double weight : {0.0, 0.1, 0.5, 0.8, 1.0}) {
        const double both = steppedVisibility(0.2, 0.9, weight);
        EXPECT_DOUBLE_EQ(0.2 + (0.9 - 0.2) * weightOfBefore(weight, 0.0), both);
        EXPECT_DOUBLE_EQ(0.9 + (0.2 - 0.9) * weightOfBefore(weight, 1.0), both);
    }
}

TEST(SunSteps, surfacesAreToldApartByDistance)
{
    EXPECT_TRUE(isSameSurface(10.0, 10.0));
    EXPECT_TRUE(isSameSurface(10.2, 10.0));
    EXPECT_FALSE(isSameSurface(9.0, 10.0));
    EXPECT_FALSE(isSameSurface(0.0, 10.0)) << "the background";
}

} // namespace
} // namespace gnomon::shared
