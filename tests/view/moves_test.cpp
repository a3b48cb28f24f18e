// SPDX-License-Identifier: Apache-2.0
// What a hand does to camera and sun, by geometry; and settings as changes and as command lines.
#include "view/camera_moves.h"

#include "app/command_line.h"
#include "command_text.h"
#include "view/edits.h"
#include "view/overlays.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace {

using namespace app::view;

host::Eye eyeAt(const glm::dvec3& position, const glm::dvec3& target)
{
    host::Eye eye;
    eye.position_ws = position;
    eye.target_ws = target;
    return eye;
}

TEST(CameraMoves, OrbitKeepsDistanceAndTurnsByTheAngle)
{
    const host::Eye eye = eyeAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0});
    // The scene turns to the right: its left side comes to the front, so the eye goes to the left.
    const host::Eye moved = orbited(eye, {0.5, 0.0});
    EXPECT_NEAR(moved.position_ws.x, -10.0 * std::sin(0.5), 1e-12);
    EXPECT_NEAR(moved.position_ws.z, 10.0 * std::cos(0.5), 1e-12);
    const host::Eye back = orbited(moved, {-0.5, 0.0});
    EXPECT_NEAR(glm::distance(back.position_ws, eye.position_ws), 0.0, 1e-12);
}

TEST(CameraMoves, NeverPassThePole)
{
    host::Eye eye = eyeAt({3.0, 4.0, 5.0}, {0.0, 0.0, 0.0});
    for (int i = 0; i < 100; ++i) {
        eye = orbited(eye, {0.01, -0.3});
    }
    EXPECT_GT(eye.position_ws.y, 0.99 * glm::length(eye.position_ws)) << "above";
    EXPECT_GT(glm::length(glm::dvec2(eye.position_ws.x, eye.position_ws.z)), 0.01) << "and not at the pole";
    for (int i = 0; i < 100; ++i) {
        eye = looked(eye, {0.0, 0.5});
    }
    const glm::dvec3 forward = glm::normalize(eye.target_ws - eye.position_ws);
    EXPECT_LT(forward.y, 1.0);
    EXPECT_GT(forward.y, 0.99);
}

TEST(CameraMoves, StraightDownIsNoDeadEnd)
{
    const host::Eye eye = eyeAt({0.0, 10.0, 0.0}, {0.0, 0.0, 0.0});
    const host::Eye moved = orbited(eye, {0.2, 0.2});
    EXPECT_TRUE(std::isfinite(moved.position_ws.x + moved.position_ws.y + moved.position_ws.z));
    EXPECT_NEAR(glm::length(moved.position_ws), 10.0, 1e-9);
    EXPECT_GT(glm::distance(moved.position_ws, eye.position_ws), 0.1);
}

TEST(CameraMoves, PanFollowsThePointer)
{
    host::Eye eye = eyeAt({0.0, 2.0, 10.0}, {0.0, 2.0, 0.0});
    const glm::uvec2 size(400, 300);
    const Aabb bounds{{-5.0F, -5.0F, -5.0F}, {5.0F, 5.0F, 5.0F}};
    const auto before = pointOf(host::cameraOf(eye, size.x, size.y, bounds).clip_from_world, eye.target_ws);
    const host::Eye moved = panned(eye, {40.0, -30.0}, 300.0);
    const auto after = pointOf(host::cameraOf(moved, size.x, size.y, bounds).clip_from_world, eye.target_ws);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR((after->x - before->x) * 400.0, 40.0, 1e-9);
    EXPECT_NEAR((after->y - before->y) * 300.0, -30.0, 1e-9);
}

TEST(CameraMoves, DollyNeverArrives)
{
    host::Eye eye = eyeAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0});
    EXPECT_NEAR(dollied(eye, 1.0).position_ws.z, 9.0, 1e-12);
    EXPECT_NEAR(dollied(dollied(eye, 3.0), -3.0).position_ws.z, 10.0, 1e-12);
    eye = dollied(eye, 60.0);
    EXPECT_GT(eye.position_ws.z, 0.0);
}

TEST(SunDome, LeadsThereAndBack)
{
    const host::Eye eye = eyeAt({4.0, 6.0, 12.0}, {0.5, 1.0, 0.0});
    const Aabb bounds{{-5.0F, -5.0F, -5.0F}, {5.0F, 5.0F, 5.0F}};
    const glm::dmat4 clip_from_world = host::cameraOf(eye, 640, 360, bounds).clip_from_world;
    const SunDome dome = domeOf(eye);
    // Of places on the side that faces the eye, the one that is seen is the one that is meant.
    for (const glm::dvec3 towards :
         {glm::dvec3(0.3, 0.7, 0.6), glm::dvec3(-0.5, 0.5, 0.7), glm::dvec3(0.1, 0.9, 0.2)}) {
        const glm::dvec3 direction = -glm::normalize(towards);
        const auto at = pointOf(clip_from_world, dome.centre_ws - direction * dome.radius_m);
        ASSERT_TRUE(at);
        const glm::dvec3 found = sunFrom(dome, lineThrough(clip_from_world, *at));
        EXPECT_NEAR(glm::distance(found, direction), 0.0, 1e-6);
    }
}

TEST(SunDome, NeverSetsTheSun)
{
    const host::Eye eye = eyeAt({0.0, 2.0, 10.0}, {0.0, 2.0, 0.0});
    const Aabb bounds{{-5.0F, -5.0F, -5.0F}, {5.0F, 5.0F, 5.0F}};
    const glm::dmat4 clip_from_world = host::cameraOf(eye, 640, 360, bounds).clip_from_world;
    for (const glm::dvec2 at :
         {glm::dvec2(0.5, 0.99), glm::dvec2(0.0, 0.5), glm::dvec2(0.5, 0.5), glm::dvec2(3.0, 7.0)}) {
        const glm::dvec3 sun = sunFrom(domeOf(eye), lineThrough(clip_from_world, at));
        EXPECT_LT(sun.y, -0.019) << at.x << ' ' << at.y;
        EXPECT_NEAR(glm::length(sun), 1.0, 1e-9);
    }
}

TEST(Overlays, ShowTheEdgesOfABox)
{
    const host::Eye eye = eyeAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0});
    const Aabb bounds{{-5.0F, -5.0F, -5.0F}, {5.0F, 5.0F, 5.0F}};
    const glm::dmat4 clip_from_world = host::cameraOf(eye, 400, 400, bounds).clip_from_world;
    // A box of 2 m around the origin: a map that looks along z.
    const glm::dmat4 map(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 0.5, 0),
                         glm::dvec4(0, 0, 0.5, 1));
    const auto edges = edgesInPicture(clip_from_world, map);
    ASSERT_EQ(edges.size(), 12U);
    for (const auto& [from, to] : edges) {
        EXPECT_TRUE(from.x > 0.3 && from.x < 0.7 && to.y > 0.3 && to.y < 0.7);
    }
    // Around the eye: what is behind it is cut off, and no edge leaps over to the other side.
    const host::Eye inside = eyeAt({0.0, 0.0, 0.0}, {0.0, 0.0, -5.0});
    const auto cut = edgesInPicture(host::cameraOf(inside, 400, 400, bounds).clip_from_world, map);
    EXPECT_EQ(cut.size(), 8U) << "four edges are behind the eye";
    for (const auto& [from, to] : cut) {
        EXPECT_TRUE(std::isfinite(from.x + from.y + to.x + to.y));
    }
}

app::Settings plain()
{
    app::Settings settings = app::defaultSettings();
    settings.subcommand = app::kRender;
    app::completeTechnique(settings);
    return settings;
}

TEST(Edits, AreTakenOrRefusedAsTheCommandLineDoes)
{
    const Edited vsm = edited(plain(), {{"filter", "vsm"}});
    ASSERT_TRUE(vsm.settings);
    EXPECT_EQ(filterOf(vsm.settings->shadow), Filter::vsm);
    const Edited refused = edited(*vsm.settings, {{"map-format", "d16"}});
    EXPECT_FALSE(refused.settings);
    EXPECT_NE(refused.refusal.find("vsm"), std::string::npos) << refused.refusal;
    EXPECT_FALSE(edited(plain(), {{"pcf.taps", "many"}}).settings);
    EXPECT_FALSE(edited(plain(), {{"eye", "1,2,3"}}).settings) << "without what it looks at";
}

TEST(Edits, LeaveAFormatThatTheNextFilterCannotHave)
{
    const Edited wide = edited(plain(), {{"filter", "evsm"}, {"map-format", "rgba32f"}});
    ASSERT_TRUE(wide.settings) << wide.refusal;
    const Edited hard = edited(*wide.settings, {{"filter", "hard"}});
    ASSERT_TRUE(hard.settings) << hard.refusal;
    EXPECT_FALSE(hard.settings->shadow.format);
}

TEST(Edits, TakeSettingsBackToTheirDefaults)
{
    const Edited made = edited(plain(), {{"sun", "1,-1,0"}, {"filter", "pcf"}, {"pcf.kernel", "7x7"}});
    ASSERT_TRUE(made.settings) << made.refusal;
    const Edited back = edited(*made.settings, {{"sun", ""}, {"pcf.kernel", ""}});
    ASSERT_TRUE(back.settings) << back.refusal;
    EXPECT_FALSE(back.settings->sun_ws);
    EXPECT_EQ(back.settings->values.at("pcf.kernel"), "3x3");
    EXPECT_EQ(back.settings->values.at("filter"), "pcf");
}

TEST(CommandOfAPicture, LeadsBackToTheSameSettings)
{
    const Edited made = edited(plain(), {{"filter", "pcf"},
                                         {"pcf.kernel", "7x7"},
                                         {"eye", "0.1,-2.30000000000000004,1e-9"},
                                         {"target", "0,0,0"},
                                         {"sun", "-0.3,-0.7,0.123456789012345678"},
                                         {"bloom", "1"},
                                         {"ground", "on"}});
    ASSERT_TRUE(made.settings) << made.refusal;
    const std::string technique = app::describeTechnique(*made.settings);
    const std::vector<std::string> words = app::commandWords(*made.settings, app::kRender, technique);
    const app::Settings again = app::parseCommandLine(words).settings;
    EXPECT_EQ(app::commandWords(again, app::kRender, app::describeTechnique(again)), words);
    EXPECT_EQ(again.shadow, made.settings->shadow);
    EXPECT_EQ(*again.eye_ws, *made.settings->eye_ws);
    EXPECT_EQ(*again.sun_ws, *made.settings->sun_ws);
    EXPECT_TRUE(again.bloom.on);
    EXPECT_EQ(again.ground, app::Ground::on);
}

} // namespace
} // namespace gnomon
