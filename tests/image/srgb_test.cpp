// SPDX-License-Identifier: Apache-2.0
#include "image/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon {
namespace {

TEST(Srgb, HasTheStandardsValues)
{
    EXPECT_EQ(decodeSrgb(0.0), 0.0);
    EXPECT_DOUBLE_EQ(decodeSrgb(1.0), 1.0);
    EXPECT_EQ(encodeSrgb(0.0), 0.0);
    EXPECT_DOUBLE_EQ(encodeSrgb(1.0), 1.0);
    // The first code of 8 bits beyond the straight part, middle grey, and half of the light, worked out by hand.
    EXPECT_NEAR(decodeSrgb(10.0 / 255.0), 0.0030352698, 1e-10);
    EXPECT_NEAR(decodeSrgb(11.0 / 255.0), 0.0033465358, 1e-10);
    EXPECT_NEAR(decodeSrgb(0.5), 0.2140411405, 1e-10);
    EXPECT_NEAR(encodeSrgb(0.5), 0.7353569831, 1e-10);
    EXPECT_NEAR(decodeSrgb(-0.1), -0.1 / 12.92, 1e-15);
    EXPECT_TRUE(std::isnan(decodeSrgb(std::numeric_limits<double>::quiet_NaN())));
    EXPECT_TRUE(std::isnan(encodeSrgb(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Srgb, ComesBackAndRises)
{
    constexpr int kSteps = 65535;
    double before = -1.0;
    for (int i = 0; i <= kSteps; ++i) {
        const double value = static_cast<double>(i) / kSteps;
        const double linear = decodeSrgb(value);
        ASSERT_GT(linear, before) << value;
        ASSERT_NEAR(encodeSrgb(linear), value, 1e-7) << value;
        before = linear;
    }
}

} // namespace
} // namespace gnomon
