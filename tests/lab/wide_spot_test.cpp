// SPDX-License-Identifier: Apache-2.0
// Masks of spot lights that are wider than one frustum holds, up to glTF's 180 degrees, beside the truth.
#include "box_scene.h"
#include "stage.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

namespace gnomon::lab::test {
namespace {

constexpr glm::uvec2 kSize_px{240, 160};

/// A floor with boxes all around a lamp 1.5 m above it.
scene::Scene lampAmongBoxes(float cone_deg)
{
    scene::Scene scene;
    addBox(scene, {-8, -1, -8}, {8, 0, 8});
    addBox(scene, {1, 0, 1}, {2, 1, 2});
    addBox(scene, {-3, 0, 0.5F}, {-2, 0.8F, 1.5F});
    addBox(scene, {-1, 0, -3}, {0.5F, 1.2F, -2.5F});
    addBox(scene, {3.5F, 0, -1}, {4, 1.4F, 0});
    addLamp(scene, {0.3F, 1.5F, 0.2F}, cone_deg);
    addView(scene, {1.0F, 9.0F, 9.0F}, {0.0F, 0.0F, 0.0F});
    finishScene(scene);
    return scene;
}

struct Case {
    Partition partition = Partition::automatic;
    float cone_deg = 0.0F;
};

std::ostream& operator<<(std::ostream& out, const Case& one)
{
    return out << nameOf(one.partition) << " of " << one.cone_deg << " degrees";
}

class WideSpots : public ::testing::TestWithParam<Case> {};

TEST_P(WideSpots, MaskAgreesWithTheTruth)
{
    const Case one = GetParam();
    Stage stage(lampAmongBoxes(one.cone_deg), "view", kSize_px, 0);
    host::RenderOptions options = filterOptions(Filter::pcf, MapFormat::d32f, 512);
    options.shadow.technique.partition = one.partition;
    const truth::Traced truth = stage.hardTruth();
    EXPECT_GT(std::ranges::count(truth.visibility.visibility.values, 0.0F), 2000) << "there are shadows to miss";
    const Score score = stage.score(options, truth);
    EXPECT_LT(score.error.value().rmse, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Partitions, WideSpots,
                         ::testing::Values(Case{Partition::automatic, 150.0F}, Case{Partition::cube, 150.0F},
                                           Case{Partition::multi, 150.0F}, Case{Partition::paraboloid, 150.0F},
                                           Case{Partition::cube, 180.0F}, Case{Partition::cube, 100.0F}));

} // namespace
} // namespace gnomon::lab::test
