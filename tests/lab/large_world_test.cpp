// SPDX-License-Identifier: Apache-2.0
// Masks beside the truth where the world is much larger than what is looked at, or far from its origin.
#include "box_scene.h"
#include "stage.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace gnomon::lab::test {
namespace {

constexpr glm::uvec2 kSize_px{240, 160};

double rmse(Stage& stage, Filter filter)
{
    const truth::Traced truth = stage.hardTruth();
    EXPECT_GT(std::ranges::count(truth.visibility.visibility.values, 0.0F), 500) << "there are shadows to miss";
    return stage.score(filterOptions(filter, MapFormat::d32f, 1024), truth).error.value().rmse;
}

/// A grille close below a lamp, over a ground.
scene::Scene grille(float ground_half_m, float below_m, float cone_deg)
{
    scene::Scene scene;
    addBox(scene, {-ground_half_m, 0, -ground_half_m}, {ground_half_m, 0, ground_half_m});
    for (int i = -3; i <= 3; ++i) {
        const float x = 0.25F * below_m * static_cast<float>(i);
        addBox(scene, {x, 3.0F - 1.02F * below_m, -below_m}, {x + 0.08F * below_m, 3.0F - below_m, below_m});
    }
    addLamp(scene, {0.0F, 3.0F, 0.0F}, cone_deg);
    addView(scene, {1.0F, 7.0F, 8.0F}, {0.0F, 0.0F, 0.0F});
    finishScene(scene);
    return scene;
}

TEST(NearDistance, LetsCastWhatIsCloseToALampInAWideWorld)
{
    for (const float cone_deg : {0.0F, 100.0F, 170.0F}) {
        for (const float below_m : {0.66F, 0.1F}) {
            SCOPED_TRACE(cone_deg);
            SCOPED_TRACE(below_m);
            Stage small(grille(10.0F, below_m, cone_deg), "view", kSize_px, 0);
            const double in_small = rmse(small, Filter::pcf);
            Stage wide(grille(3000.0F, below_m, cone_deg), "view", kSize_px, 0);
            EXPECT_LT(rmse(wide, Filter::pcf), 1.25 * in_small + 0.01);
            EXPECT_LT(in_small, 0.12);
        }
    }
}

/// Boxes on a ground whose vertices all lie `away` from the origin of their meshes.
scene::Scene boxesFarAway(const glm::vec3& away)
{
    scene::Scene scene;
    addBox(scene, away + glm::vec3(-10, -0.5F, -10), away + glm::vec3(10, 0, 10));
    addBox(scene, away + glm::vec3(-2, 0, -1), away + glm::vec3(-1, 2, 1));
    addBox(scene, away + glm::vec3(1, 0.5F, 0), away + glm::vec3(3, 0.75F, 1));
    addSun(scene, {0.6F, -1.0F, -0.4F});
    addView(scene, away + glm::vec3(0, 6, 9), away);
    finishScene(scene);
    return scene;
}

TEST(FarVertices, CostNoPrecision)
{
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::raymarch}) {
        SCOPED_TRACE(nameOf(filter));
        Stage here(boxesFarAway({0, 0, 0}), "view", kSize_px);
        const double near_rmse = rmse(here, filter);
        for (const glm::vec3& away : {glm::vec3(100000, 0, -100000), glm::vec3(-500000, 2000, 0)}) {
            Stage there(boxesFarAway(away), "view", kSize_px);
            EXPECT_LT(rmse(there, filter), 1.1 * near_rmse + 0.003) << away.x;
        }
    }
}

} // namespace
} // namespace gnomon::lab::test
