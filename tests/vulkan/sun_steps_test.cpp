// SPDX-License-Identifier: Apache-2.0
// Masks of a sun that moves in steps, against those by either of its positions alone.
#include "stepping_suns.h"
#include "write_pgm.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

class SteppingSun : public testing::TestWithParam<StepCase> {};

TEST_P(SteppingSun, isABlendOfBothPositions)
{
    Suns suns(settingOf(GetParam()));
    const Mask earlier = suns.maskOf(SunPosition::earlier)[0];
    const Mask later = suns.maskOf(SunPosition::later)[0];
    EXPECT_GT(countDifferent(earlier, later), earlier.size() / 50) << "else this says nothing";
    for (const bool smooth : {false, true}) {
        for (const double share : {0.0, 0.3, 0.5, 0.85, 1.0}) {
            const SunSteps steps = blendOf(share, smooth);
            const Mask mask = suns.maskOf({steps})[0];
            EXPECT_LE(worstOff(mask, earlier, later, steps), kRounding) << share;
            if (share == 0.0 || share == 1.0) {
                EXPECT_EQ(mask, share == 0.0 ? earlier : later);
            }
            writePgm(std::string("steps_") + GetParam().name, mask, kStepScreen);
        }
    }
    expectSilence(gpu());
}

TEST_P(SteppingSun, isOneOrTheOtherBesideTheBand)
{
    Suns suns(settingOf(GetParam()));
    const Mask earlier = suns.maskOf(SunPosition::earlier)[0];
    const Mask later = suns.maskOf(SunPosition::later)[0];
    for (const double edge : {0.0, 0.13, 0.6, 1.0, 1.25}) {
        SunSteps steps = blendOf(0.5, true);
        steps.band = 0.25;
        steps.edge = edge;
        const Mask mask = suns.maskOf({steps})[0];
        EXPECT_LE(worstOff(mask, earlier, later, steps), kRounding) << edge;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const double x = (double(i % kStepScreen.width) + 0.5) / kStepScreen.width;
            if (x < edge - 0.25) {
                ASSERT_EQ(mask[i], later[i]) << x;
            } else if (x > edge) {
                ASSERT_EQ(mask[i], earlier[i]) << x;
            }
        }
        writePgm(std::string("band_") + GetParam().name, mask, kStepScreen);
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Filters, SteppingSun,
                         testing::Values(StepCase{"hard", Filter::hard, MapFormat::d32f, Slices::one, false},
                                         StepCase{"pcf_cascades", Filter::pcf, MapFormat::d16, Slices::two, false},
                                         StepCase{"pcf_rg16_cascades", Filter::pcf, MapFormat::rg16, Slices::two, true},
                                         StepCase{"hard_rgba8", Filter::hard, MapFormat::rgba8, Slices::one, true},
                                         StepCase{"pcf_rg16f", Filter::pcf, MapFormat::rg16f, Slices::one, true},
                                         StepCase{"vsm", Filter::vsm, MapFormat::rg32f, Slices::one, false}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

// Lights of one layer whose bands lie elsewhere, one without a band and one that takes no steps part the screen
// further.
TEST(SteppingSuns, ofOneLayerAreEachTheirOwn)
{
    Setting setting;
    setting.slices = Slices::two;
    Suns suns(setting, 3);
    const auto earlier = suns.maskOf(SunPosition::earlier);
    const auto later = suns.maskOf(SunPosition::later);
    std::vector<SunSteps> steps(3, blendOf(0.4, true));
    steps[0].band = 0.3;
    steps[0].edge = 0.5;
    steps[1].band = 0.5;
    steps[1].edge = 0.9;
    const auto masks = suns.maskOf(steps);
    for (std::size_t i = 0; i < masks.size(); ++i) {
        EXPECT_LE(worstOff(masks[i], earlier[i], later[i], steps[i]), kRounding) << i;
    }
    expectSilence(gpu());
}

// Two maps in one texel equal maps with texels of their own, except for the rounding of depths.
TEST(SteppingSuns, sharedTexelsShowWhatOwnTexelsShow)
{
    for (const MapFormat format : {MapFormat::rg16, MapFormat::rgba8}) {
        Setting own;
        own.options.format = MapFormat::d16;
        Setting shared = own;
        shared.options.format = format;
        shared.paired_texels = true;
        const SunSteps steps = blendOf(0.4, false);
        const Mask a = Suns(own).maskOf({steps})[0];
        const Mask b = Suns(shared).maskOf({steps})[0];
        std::size_t off = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            off += std::abs(steps255(a, i) - steps255(b, i)) > 1 ? 1 : 0;
        }
        // Depths differ by a code at most, and the bias is more than that: only where a caster's edge is the receiver's
        // own can one go the other way.
        EXPECT_LE(off, a.size() / 1000);
    }
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
