// SPDX-License-Identifier: Apache-2.0
// The shaders' values of a filterable map's options that are left out.
#include "moment_numbers.h"

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

ShadowOptions evsm(MapFormat format, bool log_space)
{
    ShadowOptions filter{.technique = kPlainTechnique};
    filter.technique.filter = Filter::evsm;
    filter.format = format;
    filter.moments.log_space = log_space;
    return filter;
}

// Three roundings of 3/2 steps, and the arithmetic's 1e-6 (gnomon/shared/moments.h).
double varianceOf(double step)
{
    return 4.5 * step + 1e-6;
}

TEST(MomentRule, leastVarianceIsWhatRoundingTakes)
{
    ShadowOptions filter{.technique = kPlainTechnique};
    filter.technique.filter = Filter::vsm;
    for (const auto& [format, step] :
         {std::pair{MapFormat::rg16, 1.0 / 65535.0}, {MapFormat::rg16f, 0x1p-11}, {MapFormat::rg32f, 0x1p-24}}) {
        filter.format = format;
        EXPECT_NEAR(momentNumbers(filter).min_variance, varianceOf(step), 1e-3 * varianceOf(step));
        EXPECT_EQ(momentNumbers(filter).min_variance_texels, 0.5);
        EXPECT_EQ(momentNumbers(filter).rounding, 0.0);
    }
}

// Powers round in proportion to themselves, whatever the exponent; logarithms of a larger one lose more.
TEST(MomentRule, eachWarpHasItsOwnShareOfRounding)
{
    for (const auto& [format, step] : {std::pair{MapFormat::rgba16f, 0x1p-11}, {MapFormat::rgba32f, 0x1p-24}}) {
        const MomentNumbers powers = momentNumbers(evsm(format, false));
        EXPECT_NEAR(powers.rounding, varianceOf(2.0 * step), 1e-3 * powers.rounding);
        EXPECT_EQ(powers.rounding_negative, powers.rounding);
        EXPECT_EQ(powers.min_variance, 0.0) << "or it would light deep shadows";
        const MomentNumbers logarithms = momentNumbers(evsm(format, true));
        EXPECT_NEAR(logarithms.rounding, 40.0 * 4.0 / 3.0 * varianceOf(step), 1e-3 * logarithms.rounding);
        EXPECT_NEAR(logarithms.rounding_negative, 5.0 * 4.0 / 3.0 * varianceOf(step),
                    1e-3 * logarithms.rounding_negative);
    }
    ShadowOptions huge = evsm(MapFormat::rgba16f, true);
    huge.moments.evsm_positive = 10000.0F; // the most that options may have
    EXPECT_EQ(momentNumbers(huge).rounding, 1.0) << "all of it is the most";
}

TEST(MomentRule, whatIsAskedForTakesThePlaceOfBoth)
{
    ShadowOptions filter = evsm(MapFormat::rgba32f, false);
    filter.moments.min_variance = 0.25F;
    const MomentNumbers rule = momentNumbers(filter);
    EXPECT_EQ(rule.min_variance, 0.25);
    EXPECT_EQ(rule.min_variance_texels, 0.0);
    EXPECT_EQ(rule.rounding, 0.0);
    EXPECT_EQ(rule.rounding_negative, 0.0);
}

} // namespace
} // namespace gnomon::test
