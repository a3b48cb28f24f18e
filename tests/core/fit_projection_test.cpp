// SPDX-License-Identifier: Apache-2.0
// The border of a warped map, and the strongest warp that it allows.
#include "fit_stage.h"

#include "fit/projection.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using test::FitStage;
using test::Random;
using test::Stage;

TEST(FitProjection, TheStrongestWarpLeavesTheBorderBeforeTheVanishingLine)
{
    for (const std::uint32_t size : {16U, 64U, 1024U, 4096U})
        for (const double border : {0.0, 1.0, 4.0, 64.0}) {
            const double strongest = strongestWarp(border, size);
            EXPECT_GT(strongest, 1.0);
            EXPECT_LE(strongest, 1000.0);
            // 1/w falls evenly from 1 to 1/strongest over what the border leaves.
            const double share = borderShare(border, size);
            const double at_edge = 1.0 / strongest - (1.0 - 1.0 / strongest) * share;
            EXPECT_GE(at_edge, 0.4999 / strongest) << size << " " << border;
        }
    EXPECT_EQ(strongestWarp(0.0, 1024), 1000.0);
    EXPECT_NEAR(strongestWarp(4.0, 2048), 256.0, 1e-9);
}

glm::dvec2 warped(const Warp& warp, const glm::dvec2& q)
{
    const double w = warp.wAt(q);
    return glm::dvec2(glm::dot(warp.across(), q) - warp.upright, glm::dot(warp.along, q) - warp.nearest) / w;
}

glm::dvec2 unwarped(const Warp& warp, const glm::dvec2& p)
{
    const double w = warp.warped() ? 1.0 / (1.0 - p.y / warp.n) : 1.0;
    return warp.across() * (warp.upright + p.x * w) + warp.along * (warp.nearest + p.y * w);
}

TEST(FitProjection, ReadsWithinTheBorderStayWithinItsReach)
{
    Random random(5);
    int checked = 0;
    double closest = 0.0;
    for (int round = 0; round < 400; ++round) {
        Stage stage;
        stage.set.add(test::boxAt(random.inBox({-20, 0, -20}, {20, 5, 20}), random.inBox({1, 0, 1}, {40, 3, 40})));
        const glm::dvec3 eye = random.inBox({-40, 1, -40}, {40, 30, 40});
        stage.camera = test::perspectiveCamera(eye, random.inBox({-10, 0, -10}, {10, 5, 10}), random.uniform(0.2, 2.5));
        stage.light = random.below(2) == 0 ? test::sun(random.direction())
                                           : test::spot(random.inBox({-40, 5, -40}, {40, 60, 40}), {0, -1, 0}, 1.0);
        const FitStage seen(stage);
        if (!seen.found)
            continue;
        const std::uint32_t size = 64U << random.below(4);
        const double border = random.uniform(0.5, 12.0);
        FitInput input = seen.input();
        input.strongest = strongestWarp(border, size);
        for (const Fit fit : {Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm}) {
            const Warp warp = fitFunction(fit)(input);
            if (!warp.warped())
                continue;
            const MapFrame frame = frameOf(rectOf(warp, input.outline), 1e-6, size, border);
            const FitReport report = reportOf(warp, frame, input.outline);
            EXPECT_LE(report.strength, input.strongest * (1.0 + 1e-9));
            const double reach = borderReach(warp, report, border, size);
            for (const glm::dvec2& q : input.outline)
                for (int corner = 0; corner < 4; ++corner) {
                    const glm::dvec2 step((corner & 1) != 0 ? border : -border, (corner & 2) != 0 ? border : -border);
                    const glm::dvec2 p = warped(warp, q) + step * frame.texel;
                    ASSERT_TRUE(p.y < warp.n);
                    const double away = glm::distance(unwarped(warp, p), q);
                    EXPECT_LE(away, reach);
                    closest = std::max(closest, away / reach);
                    ++checked;
                }
        }
    }
    EXPECT_GT(checked, 3000);
    EXPECT_GT(closest, 0.5); // nor is it a bound of no worth
}

} // namespace
} // namespace gnomon
