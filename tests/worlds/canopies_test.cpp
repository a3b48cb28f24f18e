// SPDX-License-Identifier: Apache-2.0
// The facts of worlds/canopies.h about the world `canopies`.
#include "worlds/canopies.h"
#include "worlds/worlds.h"

#include "scene/state.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace gnomon::worlds {
namespace {

using namespace scene;

using World = CanopiesWorld;

std::array<float, 2> depthsOf(const World::Box& box)
{
    std::array<float, 2> range{1e9F, -1e9F};
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner{(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                               (i & 4) != 0 ? box.max.z : box.min.z};
        const float depth = World::depthOf(corner);
        range = {std::min(range[0], depth), std::max(range[1], depth)};
    }
    return range;
}

World::Rectangle overlapOf(const World::Rectangle& a, const World::Rectangle& b)
{
    return {std::max(a.min_x, b.min_x), std::max(a.min_z, b.min_z), std::min(a.max_x, b.max_x),
            std::min(a.max_z, b.max_z)};
}

TEST(Canopies, HasTheBoxesAndLightsOfItsHeader)
{
    const Scene scene = load("canopies", 0);
    const State state = evaluate(scene, 0.0);
    std::vector<World::Box> expected{World::sail, World::awning};
    for (int i = 0; i < World::slats; ++i) {
        expected.push_back(World::slat(i));
    }
    for (const World::Box& box : expected) {
        EXPECT_TRUE(std::any_of(state.objects.begin(), state.objects.end(), [&](const Object& object) {
            return glm::distance(object.bounds_ws.min, box.min) < 1e-5F &&
                   glm::distance(object.bounds_ws.max, box.max) < 1e-5F;
        }));
    }
    ASSERT_EQ(state.lights.size(), 2U);
    EXPECT_NEAR(glm::distance(state.lights[0].direction_ws, glm::normalize(World::sun_direction)), 0.0F, 1e-6F);
    EXPECT_EQ(state.lights[1].position_ws, World::spot_position);
    EXPECT_NEAR(World::depthOf(World::sun_direction), glm::length(World::sun_direction), 1e-5F);
}

TEST(Canopies, PlanesAcrossTheSunPartItsRoofs)
{
    const auto ground = depthsOf({{-World::ground_half_size_m, 0.0F, -World::ground_half_size_m},
                                  {World::ground_half_size_m, 0.0F, World::ground_half_size_m}});
    const auto awning = depthsOf(World::awning);
    const auto sail = depthsOf(World::sail);
    EXPECT_LT(awning[1], ground[0]);
    EXPECT_LT(sail[1], awning[0]);
    for (int i = 0; i < World::slats; ++i) {
        EXPECT_LT(depthsOf(World::slat(i))[1], sail[0]);
    }
}

TEST(Canopies, BordersOfHigherRoofsCrossLowerOnes)
{
    // Not only their shadows overlap: the lower roof's umbra holds ground on both sides of a slat's border.
    const World::Rectangle awning = World::umbraOf(World::awning);
    int crossed = 0;
    for (int i = 0; i < World::slats; ++i) {
        const World::Rectangle slat = overlapOf(World::umbraOf(World::slat(i)), awning);
        crossed += slat.max_x > slat.min_x && slat.max_z > slat.min_z && slat.max_x < awning.max_x - 0.3F ? 1 : 0;
    }
    EXPECT_GE(crossed, 3);
    const World::Rectangle both = overlapOf(World::umbraOf(World::sail), awning);
    EXPECT_GT(both.max_x - both.min_x, 0.5F);
    EXPECT_GT(both.max_z - both.min_z, 2.0F);
}

TEST(Canopies, UmbraeLieWithinReaches)
{
    for (const World::Box& box : {World::sail, World::awning, World::slat(0)}) {
        const World::Rectangle umbra = World::umbraOf(box);
        const World::Rectangle reach = World::reachOf(box);
        EXPECT_LT(umbra.min_x, umbra.max_x);
        EXPECT_LT(umbra.min_z, umbra.max_z);
        EXPECT_LT(reach.min_x, umbra.min_x);
        EXPECT_LT(reach.min_z, umbra.min_z);
        EXPECT_GT(reach.max_x, umbra.max_x);
        EXPECT_GT(reach.max_z, umbra.max_z);
        const float x = 0.5F * (umbra.min_x + umbra.max_x);
        EXPECT_TRUE(umbra.holds(x, umbra.min_z + 0.1F));
        EXPECT_FALSE(umbra.holds(x, umbra.min_z - 0.1F));
    }
}

} // namespace
} // namespace gnomon::worlds
