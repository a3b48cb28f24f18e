// SPDX-License-Identifier: Apache-2.0
// Exposure by the light on what is seen, whatever the size of the ground around it.
#include "host/src/seen_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gnomon::host {
namespace {

ShadedLight lampAt(const glm::dvec3& place, double candela, LightType type = LightType::point)
{
    ShadedLight light;
    light.caster.type = type;
    light.caster.position_ws = place;
    light.caster.outer_half_angle_rad = 0.5;
    light.colour = glm::vec3(static_cast<float>(candela));
    return light;
}

ObjectSet groundOf(float half_m)
{
    ObjectSet objects;
    objects.add({{-half_m, 0, -half_m}, {half_m, 0, half_m}});
    return objects;
}

Sight sightFrom(const glm::dvec3& eye, const glm::dvec3& target, const Aabb& bounds)
{
    return sightOf({.position_ws = eye, .target_ws = target}, 320, 200, bounds);
}

double given(const std::vector<ShadedLight>& lights, const ObjectSet& objects, const glm::dvec3& eye,
             const glm::dvec3& target, std::size_t light = 0)
{
    SeenLight seen;
    return seen.find(lights, objects, sightFrom(eye, target, objects.bounds()))[light];
}

TEST(SeenLight, DoesNotFollowTheSizeOfTheGround)
{
    for (const LightType type : {LightType::spot, LightType::point}) {
        const std::vector<ShadedLight> lamp{lampAt({0, 4, 0}, 400.0, type)};
        const double small = given(lamp, groundOf(10.0F), {0, 4, 12}, {0, 0, 0});
        EXPECT_GT(small, 400.0 / 16.0 / 5.0);
        EXPECT_LE(small, 1.001 * 400.0 / 16.0);
        for (const float half_m : {100.0F, 1000.0F, 30000.0F}) {
            const double wide = given(lamp, groundOf(half_m), {0, 4, 12}, {0, 0, 0});
            EXPECT_GT(wide, 0.5 * small) << half_m;
            EXPECT_LT(wide, 2.0 * small) << half_m;
        }
    }
}

TEST(SeenLight, IsTheLampsThatIsSeen)
{
    const ObjectSet ground = groundOf(300.0F);
    // The bright one lies behind the camera.
    const std::vector<ShadedLight> lamps{lampAt({0, 4, 0}, 400.0), lampAt({0, 4, 200}, 4000.0)};
    EXPECT_LT(given(lamps, ground, {0, 4, 12}, {0, 0, 0}, 1), given(lamps, ground, {0, 4, 12}, {0, 0, 0}, 0));
    EXPECT_GT(given(lamps, ground, {0, 4, 12}, {0, 0, 0}, 1), 0.0) << "a picture of the dark is not without end bright";
    EXPECT_GT(given(lamps, ground, {0, 4, 180}, {0, 0, 200}, 1), given(lamps, ground, {0, 4, 180}, {0, 0, 200}, 0));
}

TEST(SeenLight, ChangesLittleWithAStepOfTheCamera)
{
    const ObjectSet ground = groundOf(300.0F);
    const std::vector<ShadedLight> lamp{lampAt({0, 4, 0}, 400.0)};
    double before = 0.0;
    for (int degrees = 0; degrees < 360; ++degrees) { // it turns on its place
        const double turn_rad = degrees * 3.14159265358979 / 180.0;
        const double now =
            given(lamp, ground, {0, 4, 12}, {12.0 * std::sin(turn_rad), 1, 12.0 - 12.0 * std::cos(turn_rad)});
        if (degrees > 0) {
            EXPECT_LT(std::abs(std::log2(now / before)), 0.2) << degrees;
        }
        before = now;
    }
}

TEST(SeenLight, KnowsRoomsAndBulbs)
{
    ObjectSet room;
    room.add({{-3, 0, -3}, {3, 3, 3}});
    const std::vector<ShadedLight> lamp{lampAt({0, 2.5, 0}, 100.0)};
    const double empty = given(lamp, room, {0, 1.5, 2.9}, {0, 0.5, 0});
    EXPECT_GT(empty, 100.0 / 16.0);
    EXPECT_LT(empty, 100.0);
    room.add({{-0.05F, 2.45F, -0.05F}, {0.05F, 2.55F, 0.05F}}); // a bulb around the lamp
    EXPECT_NEAR(given(lamp, room, {0, 1.5, 2.9}, {0, 0.5, 0}), empty, 1e-9);
}

TEST(SeenLight, EndsAtWhatItMeetsFirst)
{
    ObjectSet objects = groundOf(10.0F);
    std::vector<ShadedLight> lamp{lampAt({0, 4, 0}, 400.0)};
    lamp[0].caster.range_m = 30.0;
    const double alone = given(lamp, objects, {0, 4, 12}, {0, 0, 0});
    objects.add({{-10, -8, -10}, {10, -8, 10}}); // beneath the ground
    EXPECT_NEAR(given(lamp, objects, {0, 4, 12}, {0, 0, 0}), alone, 1e-9);
}

TEST(SeenLight, OfNothingIsNothing)
{
    const std::vector<ShadedLight> lamp{lampAt({0, 4, 0}, 400.0), lampAt({0, 4, 0}, 7.0, LightType::directional)};
    SeenLight seen;
    const ObjectSet nothing;
    const auto found = seen.find(lamp, nothing, sightFrom({0, 4, 12}, {0, 0, 0}, {{-1, -1, -1}, {1, 1, 1}}));
    EXPECT_EQ(found[0], 0.0);
    EXPECT_NEAR(found[1], 7.0, 1e-9);
    std::vector<ShadedLight> many(40, lampAt({0, 4, 0}, 1.0));
    many[39] = lampAt({0, 4, 0}, 2.0);
    const ObjectSet ground = groundOf(10.0F);
    EXPECT_GT(given(many, ground, {0, 4, 12}, {0, 0, 0}, 39), given(many, ground, {0, 4, 12}, {0, 0, 0}, 0));
}

} // namespace
} // namespace gnomon::host
