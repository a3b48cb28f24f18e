// SPDX-License-Identifier: Apache-2.0
// The mask of a ground that the sun all but grazes, beside the truth: a part of the sun's disc is below the horizon.
#include "box_scene.h"
#include "stage.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <ostream>

namespace gnomon::lab::test {
namespace {

struct Case {
    Filter filter = Filter::hard;
    float rise = 0.0F; // of the sun over the ground, by length
};

std::ostream& operator<<(std::ostream& out, const Case& one)
{
    return out << nameOf(one.filter) << " under a sun that rises by " << one.rise;
}

class GrazingSun : public ::testing::TestWithParam<Case> {};

TEST_P(GrazingSun, LightsTheGroundByWhatIsOverTheHorizon)
{
    const Case one = GetParam();
    scene::Scene scene;
    addBox(scene, {-12, -1, -12}, {12, 0, 12});
    addBox(scene, {1, 0, 1}, {2, 1, 2});
    addBox(scene, {-3, 0, 0.5F}, {-2, 0.8F, 1.5F});
    addSun(scene, {1.0F, -one.rise, 0.2F}, 0.0093F);
    addView(scene, {3.0F, 9.0F, 12.0F}, {0.0F, 0.0F, 0.0F});
    finishScene(scene);
    Stage stage(std::move(scene), "view", {240, 160}, 0);
    const MapFormat format = one.filter == Filter::vsm ? MapFormat::rg32f : MapFormat::d32f;
    const Score score = stage.score(filterOptions(one.filter, format, 512), stage.areaTruth(64));
    ASSERT_GT(score.pixels.counts.grazing, 5000U);
    EXPECT_LT(score.grazing_rmse.value(), 0.2); // 0.5 and more where such light is taken for none
}

INSTANTIATE_TEST_SUITE_P(Filters, GrazingSun,
                         ::testing::Values(Case{Filter::hard, 0.001F}, Case{Filter::hard, 0.003F},
                                           Case{Filter::pcf, 0.001F}, Case{Filter::vsm, 0.001F},
                                           Case{Filter::pcss, 0.001F}, Case{Filter::raymarch, 0.001F}));

} // namespace
} // namespace gnomon::lab::test
