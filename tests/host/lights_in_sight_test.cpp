// SPDX-License-Identifier: Apache-2.0
#include "host/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gnomon::host {
namespace {

const Aabb kScene{{-500.0F, 0.0F, -500.0F}, {500.0F, 10.0F, 500.0F}};

ShadedLight lampAt(const glm::dvec3& place, double brightness, double range_m)
{
    ShadedLight light;
    light.caster.type = LightType::point;
    light.caster.position_ws = place;
    light.caster.range_m = range_m;
    light.caster.brightness = brightness;
    return light;
}

/// Lamps 2 m apart along the line of sight, before the eye and behind it; the first is as far behind as can be.
std::vector<ShadedLight> row(int count)
{
    std::vector<ShadedLight> lights;
    for (int i = 0; i < count; ++i) {
        lights.push_back(lampAt({0.0, 3.0, count - 2.0 * i}, 1.0, 5.0));
    }
    return lights;
}

Camera cameraAlong(double height_m)
{
    Eye eye;
    eye.position_ws = {0.0, 3.0, 0.0};
    eye.target_ws = {0.0, 3.0, -1.0};
    eye.height_m = height_m;
    return cameraOf(eye, 16, 9, kScene);
}

TEST(LightsInSight, LeavesOutThoseWhoseRaysAreNotInTheView)
{
    const std::vector<ShadedLight> lights = row(200); // z from 200 down to -198: half of them are behind
    const LightsInSight chosen = lightsInSight(lights, cameraAlong(0.0), kScene, 0);
    EXPECT_EQ(chosen.left_out, 0U);
    EXPECT_EQ(chosen.lights.front(), 0U); // as asked for
    EXPECT_TRUE(std::is_sorted(chosen.lights.begin() + 1, chosen.lights.end()));
    // Two behind the eye reach before it: at 4 m and at 2 m.
    EXPECT_EQ(chosen.lights[1], 98U);
    EXPECT_EQ(chosen.lights.back(), 199U);
    EXPECT_EQ(chosen.lights.size(), 103U);
}

TEST(LightsInSight, TakesThoseThatGiveTheMostHere)
{
    std::vector<ShadedLight> lights = row(500);
    lights[490].caster.brightness = 1e9;            // far away, and brighter than all
    lights[260].caster.brightness = 0.0;            // near, and out
    lights[5].caster.type = LightType::directional; // anywhere
    const LightsInSight chosen = lightsInSight(lights, cameraAlong(0.0), kScene, 400);
    EXPECT_EQ(chosen.lights.size(), kMaxLights);
    EXPECT_EQ(chosen.lights.front(), 400U);
    const auto has = [&](std::uint32_t light) {
        return std::find(chosen.lights.begin(), chosen.lights.end(), light) != chosen.lights.end();
    };
    EXPECT_TRUE(has(490));
    EXPECT_TRUE(has(5));
    EXPECT_TRUE(has(251));
    EXPECT_FALSE(has(260));
    EXPECT_FALSE(has(100)); // behind
    EXPECT_FALSE(has(489)); // far
    // z = 500 - 2 i: from 248 on they reach into the view, without 260; beside them the sun.
    EXPECT_EQ(chosen.left_out + chosen.lights.size(), 500U - 248U);
    const LightsInSight again = lightsInSight(lights, cameraAlong(0.0), kScene, 400);
    EXPECT_EQ(again.lights, chosen.lights);
}

TEST(LightsInSight, AnOrthographicCameraSeesThemByHowFarOutsideTheyAre)
{
    std::vector<ShadedLight> lights;
    for (int i = 0; i < 300; ++i) {
        lights.push_back(lampAt({i * 0.1, 3.0, -400.0 + i}, 1.0, 8.0));
    }
    const LightsInSight chosen = lightsInSight(lights, cameraAlong(9.0), kScene, 0); // 16 m wide
    // Within 8 m of the middle all are in the view, however far along it; up to 16 m they reach into it.
    EXPECT_EQ(chosen.left_out, 161U - kMaxLights);
    std::vector<std::uint32_t> nearest(kMaxLights);
    for (std::uint32_t i = 0; i < kMaxLights; ++i) {
        nearest[i] = i;
    }
    EXPECT_EQ(chosen.lights, nearest);
}

} // namespace
} // namespace gnomon::host
