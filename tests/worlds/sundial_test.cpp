// SPDX-License-Identifier: Apache-2.0
// The facts of worlds/sundial.h about the world `sundial`: the courses of sun and moon, and the things below them.
#include "allocation_count.h"

#include "scene/hash.h"
#include "scene/state.h"
#include "worlds/sundial.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace gnomon::worlds {
namespace {

using namespace scene;

using World = SundialWorld;

constexpr double kHalfTurn = std::numbers::pi;

/// Above the horizon, from the way the light travels.
double heightOf(const glm::dvec3& direction_ws)
{
    return std::asin(-direction_ws.y);
}

/// From north, clockwise seen from above.
double azimuthOf(const glm::dvec3& towards)
{
    return std::atan2(towards.x, -towards.z);
}

const Scene& sundial()
{
    static const Scene scene = load("sundial", 1);
    return scene;
}

TEST(SundialCourse, ClockRunsSixtyTimesAsFastAndStartsInTheMorning)
{
    EXPECT_DOUBLE_EQ(World::hourOf(0.0), 8.0);
    EXPECT_DOUBLE_EQ(World::hourOf(60.0), 9.0);
    EXPECT_DOUBLE_EQ(World::hourOf(16.0 * 60.0), 0.0);
    EXPECT_DOUBLE_EQ(World::hourOf(-60.0), 7.0);
    for (const double hour : {0.0, 5.25, 8.0, 12.0, 23.75}) {
        const double time_s = World::timeOf(hour);
        EXPECT_GE(time_s, 0.0);
        EXPECT_LT(time_s, World::day_s);
        EXPECT_NEAR(World::hourOf(time_s), hour, 1e-9);
    }
}

TEST(SundialCourse, SunAndMoonCulminateInTheSouthAsHighAsLatitudeAndDeclinationSay)
{
    const double noon = World::timeOf(12.0);
    EXPECT_NEAR(heightOf(World::sunDirection(noon)), kHalfTurn / 2.0 - World::latitude_rad + World::sun_declination_rad,
                1e-12);
    const double midnight = World::timeOf(0.0);
    EXPECT_NEAR(heightOf(World::moonDirection(midnight)),
                kHalfTurn / 2.0 - World::latitude_rad + World::moon_declination_rad, 1e-12);
    for (const glm::dvec3& towards : {-World::sunDirection(noon), -World::moonDirection(midnight)}) {
        EXPECT_NEAR(towards.x, 0.0, 1e-12);
        EXPECT_GT(towards.z, 0.0); // the south
    }
    EXPECT_NEAR(heightOf(World::sunDirection(midnight)),
                World::latitude_rad + World::sun_declination_rad - kHalfTurn / 2.0, 1e-12);
    // In the morning the sun is in the east, and rises.
    const glm::dvec3 morning = -World::sunDirection(0.0);
    EXPECT_GT(morning.x, 0.5);
    EXPECT_GT(heightOf(World::sunDirection(1.0)), heightOf(World::sunDirection(0.0)));
}

TEST(SundialCourse, SunCrossesTheHorizonAtSunriseAndSunset)
{
    EXPECT_NEAR(heightOf(World::sunDirection(World::timeOf(World::sunriseHour()))), 0.0, 1e-9);
    EXPECT_NEAR(heightOf(World::sunDirection(World::timeOf(World::sunsetHour()))), 0.0, 1e-9);
    EXPECT_GT(World::sunriseHour(), 4.5); // before six, as it is summer
    EXPECT_LT(World::sunriseHour(), 6.0);
    for (int minute = 1; minute < 24 * 60; ++minute) {
        const double hour = minute / 60.0;
        const bool day = hour > World::sunriseHour() && hour < World::sunsetHour();
        EXPECT_EQ(heightOf(World::sunDirection(World::timeOf(hour))) > 0.0, day) << hour;
    }
}

TEST(SundialCourse, StrengthsAreContinuousAndFadeBetweenTheirHeights)
{
    double most_sun = 0.0;
    double most_moon = 0.0;
    double step_sun = 0.0;
    double step_moon = 0.0;
    for (double time_s = 0.0; time_s < World::day_s; time_s += 0.25) {
        const std::array<std::array<double, 2>, 2> pairs{
            {{heightOf(World::sunDirection(time_s)), World::sunStrength(time_s)},
             {heightOf(World::moonDirection(time_s)), World::moonStrength(time_s)}}};
        for (const auto& [height, strength] : pairs) {
            if (height <= World::fade_from_rad) {
                EXPECT_EQ(strength, 0.0) << time_s;
            } else if (height >= World::fade_to_rad) {
                EXPECT_EQ(strength, 1.0) << time_s;
            } else {
                EXPECT_GT(strength, 0.0) << time_s;
                EXPECT_LT(strength, 1.0) << time_s;
            }
        }
        most_sun = std::max(most_sun, pairs[0][1]);
        most_moon = std::max(most_moon, pairs[1][1]);
        step_sun = std::max(step_sun, std::abs(World::sunStrength(time_s + 0.25) - pairs[0][1]));
        step_moon = std::max(step_moon, std::abs(World::moonStrength(time_s + 0.25) - pairs[1][1]));
    }
    EXPECT_EQ(most_sun, 1.0);
    EXPECT_EQ(most_moon, 1.0);
    // The fade spans 5 degrees, which take some 30 s: a quarter second is at most 1.5 / 120 of it.
    EXPECT_LT(step_sun, 0.015);
    EXPECT_LT(step_moon, 0.015);
    EXPECT_GT(step_sun, 0.001);
}

TEST(SundialCourse, RepeatsDayByDay)
{
    const Scene& scene = sundial();
    for (const double time_s : {0.0, 123.25, 700.0, 1300.5}) {
        EXPECT_NEAR(glm::distance(World::sunDirection(time_s), World::sunDirection(time_s + World::day_s)), 0.0, 1e-9);
        EXPECT_NEAR(glm::distance(World::moonDirection(time_s), World::moonDirection(time_s + World::day_s)), 0.0,
                    1e-9);
        EXPECT_NEAR(World::sunStrength(time_s), World::sunStrength(time_s + World::day_s), 1e-9);
        // The walker is back too.
        const State today = evaluate(scene, time_s);
        const State tomorrow = evaluate(scene, time_s + World::day_s);
        for (std::size_t i = 0; i < today.objects.size(); ++i) {
            EXPECT_LT(glm::distance(today.objects[i].bounds_ws.centre(), tomorrow.objects[i].bounds_ws.centre()),
                      1e-3F);
        }
    }
}

TEST(Sundial, LightsFollowTheCourse)
{
    const Scene& scene = sundial();
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[0].name, "sun");
    EXPECT_EQ(scene.lights[1].name, "moon");
    EXPECT_NEAR(scene.lights[1].angular_diameter_rad, 0.52 * kHalfTurn / 180.0, 1e-6);
    State state = evaluate(scene, 0.0);
    for (const double hour : {0.0, 5.0, 6.0, 9.0, 12.0, 18.0, 18.6, 19.0, 22.0}) {
        const double time_s = World::timeOf(hour);
        advance(scene, time_s, state);
        EXPECT_LT(glm::distance(glm::dvec3(state.lights[0].direction_ws), World::sunDirection(time_s)), 1e-5) << hour;
        EXPECT_LT(glm::distance(glm::dvec3(state.lights[1].direction_ws), World::moonDirection(time_s)), 1e-5) << hour;
        // The sun's tint takes nothing from its red; the moon has none.
        EXPECT_NEAR(state.lights[0].strength.x, World::sunStrength(time_s), 1e-6) << hour;
        EXPECT_LE(state.lights[0].strength.z, state.lights[0].strength.y) << hour;
        EXPECT_EQ(state.lights[1].strength, glm::vec3(static_cast<float>(World::moonStrength(time_s)))) << hour;
    }
}

TEST(Sundial, SkyFollowsTheHourWithoutJumps)
{
    const Scene& scene = sundial();
    const auto sky = [&](double hour) {
        return evaluate(scene, World::timeOf(hour)).environment;
    };
    EXPECT_GT(sky(12.0).sky_zenith.z, 10.0F * sky(0.0).sky_zenith.z);
    const Environment dusk = sky(World::sunsetHour());
    EXPECT_GT(dusk.sky_horizon.x, 1.5F * dusk.sky_horizon.z); // red
    State state = evaluate(scene, 0.0);
    glm::vec3 before = state.environment.sky_horizon;
    for (double time_s = 1.0; time_s <= World::day_s; time_s += 1.0) {
        advance(scene, time_s, state);
        EXPECT_LT(glm::distance(state.environment.sky_horizon, before), 0.04F) << time_s;
        before = state.environment.sky_horizon;
    }
}

TEST(Sundial, StyleShowsTheHour)
{
    // The tip's shadow lies on the line of the hour, as does all of the style's, which starts in the dial's middle.
    const double c = std::cos(World::latitude_rad);
    const double s = std::sin(World::latitude_rad);
    const glm::dvec3 tip = glm::dvec3(0.0, s, -c) * static_cast<double>(World::style_length_m);
    for (double hour = 6.0; hour <= 18.0; hour += 0.5) {
        const glm::dvec3 sunlight = World::sunDirection(World::timeOf(hour));
        const glm::dvec3 shadow = tip - sunlight * (tip.y / sunlight.y);
        EXPECT_NEAR(std::remainder(azimuthOf(shadow) - World::hourLineAzimuth(hour), 2.0 * kHalfTurn), 0.0, 1e-9)
            << hour;
    }
    // And the drawn gnomon has that tip.
    const Scene& scene = sundial();
    const glm::vec3 drawn = glm::vec3(tip) + glm::vec3(0.0F, World::dial_y, 0.0F);
    float nearest = 1e9F;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            for (const glm::vec3& p : primitive.positions) {
                nearest = mesh.name == "sundial" ? std::min(nearest, glm::distance(p, drawn)) : nearest;
            }
        }
    }
    EXPECT_LT(nearest, 0.03F);
}

TEST(Sundial, HasWhatWasPromised)
{
    const Scene& scene = sundial();
    std::array<std::string, 5> names{"meadow", "long", "porch", "overhead", "face"};
    ASSERT_EQ(scene.views.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(scene.views[i].name, names[i]);
    }
    std::size_t triangles = 0;
    std::size_t masked = 0;
    for (const Object& object : evaluate(scene, 0.0).objects) {
        triangles += scene.meshes[object.mesh].primitives[object.primitive].indices.size() / 3;
        masked += scene.materials[object.material].alpha_mode == AlphaMode::mask ? 1 : 0;
    }
    EXPECT_GT(triangles, 60'000U);
    EXPECT_LT(triangles, 150'000U);
    EXPECT_GT(masked, 180U); // of which trees are instances
    for (const char* wanted : {"sundial", "house", "fence/north", "fence/garden left", "tree/oaks 0", "walker/body"}) {
        EXPECT_TRUE(std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) {
            return n.name == wanted;
        })) << wanted;
    }
}

TEST(Sundial, LongViewSeesOverTheOpenGround)
{
    const Scene& scene = sundial();
    const NamedView& view = scene.views[1];
    float ground = -1e9F; // below the eye: the highest vertex of the ground within a metre of it
    float farthest = 0.0F;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.name.starts_with("ground/")) {
            continue;
        }
        for (const glm::vec3& p : mesh.primitives[0].positions) {
            if (glm::distance(glm::vec2(p.x, p.z), glm::vec2(view.eye.x, view.eye.z)) < 1.0F) {
                ground = std::max(ground, p.y);
            }
            farthest = std::max(farthest, glm::distance(p, view.eye));
        }
    }
    EXPECT_NEAR(view.eye.y - ground, 1.7F, 0.15F);
    EXPECT_GT(farthest, 160.0F);
}

TEST(Sundial, OnlyTheWalkerMoves)
{
    const Scene& scene = sundial();
    const State before = evaluate(scene, 10.0);
    const State after = evaluate(scene, 10.5);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < before.objects.size(); ++i) {
        const Object& object = before.objects[i];
        const bool walks = scene.nodes[object.node].name.starts_with("walker/");
        EXPECT_EQ(object.dynamic, walks) << scene.nodes[object.node].name;
        EXPECT_TRUE(object.casts || !walks);
        if (object.world_from_object != after.objects[i].world_from_object) {
            ++moved;
            EXPECT_TRUE(walks) << scene.nodes[object.node].name;
        }
    }
    EXPECT_EQ(moved, 5U);
    const auto body =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [](const Node& n) { return n.name == "walker/body"; });
    ASSERT_NE(body, scene.nodes.end());
    const auto index = static_cast<std::size_t>(body - scene.nodes.begin());
    const glm::vec3 way = after.nodes[index].transform.translation - before.nodes[index].transform.translation;
    const float speed = glm::length(glm::vec2(way.x, way.z)) / 0.5F;
    EXPECT_GT(speed, 1.1F);
    EXPECT_LT(speed, 1.5F);
    const glm::vec3 facing = before.nodes[index].transform.rotation * glm::vec3(0, 0, 1);
    EXPECT_GT(glm::dot(glm::normalize(glm::vec3(way.x, 0, way.z)), facing), 0.9F);
}

TEST(Sundial, LooksAreNoPartOfAStatesHash)
{
    State state = evaluate(sundial(), 0.0);
    const Hash128 hash = stateHash(state);
    state.lights[0].strength *= 0.5F;
    state.environment.ambient *= 0.5F;
    EXPECT_EQ(stateHash(state), hash);
    state.lights[0].direction_ws.x += 0.001F;
    EXPECT_NE(stateHash(state), hash);
}

} // namespace
} // namespace gnomon::worlds
