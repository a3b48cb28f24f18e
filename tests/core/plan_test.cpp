// SPDX-License-Identifier: Apache-2.0
// Plans with answers that can be worked out by hand.
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <limits>

namespace gnomon {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A floor of 20 x 20 m seen from far above, a box of 2 m a metre over it, and a particle high up in the light's way.
struct World {
    ObjectSet set;
    std::vector<Light> lights;
    Frame frame;

    World()
    {
        set.add({{-10, 0, -10}, {10, 0, 10}}, {false, true, false});
        set.add({{-1, 1, -1}, {1, 3, 1}});
        set.add({{4, 100, 4}, {5, 101, 5}}, {true, false, true});
        frame.objects = &set;
        frame.camera = test::orthographicCamera({0, 500, 0}, {0, 0, 0}, 50.0);
        lights.push_back(test::sun({0, -1, 0}));
    }
    const Plan& plan(Planner& planner)
    {
        frame.lights = lights;
        return planner.plan(frame);
    }
    OutcomeKind outcome(const ShadowOptions& options = {})
    {
        Planner planner(options);
        const Plan& made = plan(planner);
        const Outcome outcome = made.lights.at(0).outcome;
        EXPECT_EQ(outcome.hasMap(), made.lights[0].view_count > 0);
        EXPECT_EQ(outcome.reason.empty(), outcome.kind == OutcomeKind::ok);
        return outcome.kind;
    }
};

glm::dvec3 project(const View& view, const glm::dvec3& p_ws)
{
    const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(p_ws, 1.0);
    return glm::dvec3(c) / c.w;
}

TEST(UniformFit, RectangleOfAKnownFloorUnderAVerticalSun)
{
    World world;
    Planner planner({.technique = kPlainTechnique, .map_size = 1008, .border_texels = 4.0});
    const Plan& plan = world.plan(planner);
    ASSERT_EQ(plan.views.size(), 1U);
    const View& view = plan.views[0];
    // 20 m over 1008 - 8 texels; the padding of the body does not show, because the boxes' own rectangle is tighter.
    EXPECT_NEAR(view.projection.texel_m, 0.02, 1e-9);
    EXPECT_NEAR(view.projection.texel_xy_m.x, 0.02, 1e-9);
    EXPECT_NEAR(view.projection.texel_xy_m.y, 0.02, 1e-9);
    EXPECT_TRUE(view.projection.orthographic);
    EXPECT_TRUE(view.projection.clamp_near);
    // Straight down: right is +x, up is -z, and y is down in the map.
    const double edge = 1000.0 / 1008.0;
    EXPECT_NEAR(glm::distance(glm::dvec2(project(view, {10, 0, 10})), glm::dvec2(edge, edge)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(glm::dvec2(project(view, {-10, 0, 10})), glm::dvec2(-edge, edge)), 0.0, 1e-9);
    EXPECT_EQ(plan.casters, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(plan.receivers, (std::vector<std::uint32_t>{0, 1}));
}

TEST(UniformFit, DepthsAreMetresAlongTheLight)
{
    World world;
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    const View& view = world.plan(planner).views.at(0);
    // The particle at 100 m is clamped: what can be told apart starts three times the receivers' own range (the box's
    // top is at 3 m) above the highest of them.
    const auto metric = [&](const glm::dvec3& p) {
        return glm::dot(view.projection.metric.metric_ws, glm::dvec4(p, 1.0));
    };
    EXPECT_NEAR(metric({0, 12, 0}), 0.0, 1e-3);
    EXPECT_NEAR(metric({0, 0, 0}), 1.0, 1e-3);
    EXPECT_LE(metric({0, 0, 0}), 1.0);
    EXPECT_GE(metric({0, 12, 0}), 0.0);
    EXPECT_LT(metric({4, 100, 4}), 0.0);
    EXPECT_NEAR(project(view, {2, 1.5, 3}).z, metric({2, 1.5, 3}), 1e-12);
    EXPECT_NEAR(view.projection.metric.far_m - view.projection.metric.near_m, 12.0, 0.01);
}

TEST(UniformFit, AFlatFloorLeavesRoomForTheBiasOfWhatIsClamped)
{
    World world;
    world.set.remove(world.set.idAt(1)); // the floor is all that receives, and has no depth range of its own
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    const View& view = world.plan(planner).views.at(0);
    const double floor = glm::dot(view.projection.metric.metric_ws, glm::dvec4(0, 0, 0, 1));
    EXPECT_GE(floor * (view.projection.metric.far_m - view.projection.metric.near_m), 60.0 * view.projection.texel_m);
    EXPECT_LE(view.projection.metric.far_m - view.projection.metric.near_m, 70.0 * view.projection.texel_m);
}

TEST(UniformFit, Equation6PutsTheLightBeforeEverythingThatCasts)
{
    World world;
    world.lights[0] = test::sun({0.5, -1, 0.25});
    ShadowOptions options{.technique = kPlainTechnique};
    options.level_depth = false; // distances from the light's plane
    Planner planner(options);
    const Plan& plan = world.plan(planner);
    const View& view = plan.views.at(0);
    const glm::dvec3 forward = world.lights[0].direction_ws;
    for (const std::uint32_t caster : plan.casters)
        for (int i = 0; i < 8; ++i)
            EXPECT_GE(
                glm::dot(forward, glm::dvec3(world.set.bounds(caster).corner(i)) - view.projection.light_place_ws),
                -1e-9);
    // On the line through the centre of what is seen, against the light.
    const glm::dvec3 centre(0.0, 1.5, 0.0);
    EXPECT_NEAR(glm::length(glm::cross(forward, view.projection.light_place_ws - centre)), 0.0, 1e-3);
    // metric_ws and near_m, far_m say the same.
    const glm::dvec3 p(3, 1, -2);
    const double depth = glm::dot(forward, p - view.projection.light_place_ws);
    EXPECT_NEAR(glm::dot(view.projection.metric.metric_ws, glm::dvec4(p, 1.0)),
                (depth - view.projection.metric.near_m) /
                    (view.projection.metric.far_m - view.projection.metric.near_m),
                1e-12);
}

TEST(UniformFit, CastersThatOnlyAFilterSeesAreDrawnToo)
{
    World world;
    const ObjectId in_border = world.set.add({{10.2F, 1, 0}, {10.5F, 2, 1}}, {true, false, false});
    const ObjectId beyond = world.set.add({{13, 1, 0}, {14, 2, 1}}, {true, false, false});
    Planner planner({.technique = kPlainTechnique,
                     .map_size = 108,
                     .border_texels = 4.0}); // texels of 0.2 m, four of them around the floor
    const Plan& plan = world.plan(planner);
    EXPECT_TRUE(std::binary_search(plan.casters.begin(), plan.casters.end(), in_border.index));
    EXPECT_FALSE(std::binary_search(plan.casters.begin(), plan.casters.end(), beyond.index));
}

TEST(UniformFit, AxesDoNotTurnWithTheCameraNorJumpAtNoon)
{
    World world;
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    glm::dvec3 last(0.0);
    for (int step = -20; step <= 20; ++step) {
        world.lights[0] = test::sun({1e-4 * step, -1, 5e-5 * step});
        const double turn = 0.3 * step;
        world.frame.camera = test::perspectiveCamera({20 * std::cos(turn), 15, 20 * std::sin(turn)}, {0, 0, 0}, 1.2);
        const View& view = world.plan(planner).views.at(0);
        const glm::dvec3 right = glm::normalize(glm::dvec3(glm::transpose(view.projection.clip_from_world)[0]));
        if (step > -20) {
            EXPECT_LT(glm::distance(right, last), 1e-3);
        }
        last = right;
    }
    EXPECT_NEAR(last.x, 1.0, 1e-2);
}

TEST(UniformFit, SpotOverAFloor)
{
    World world;
    world.lights[0] = test::spot({0, 10, 0}, {0, -1, 0}, glm::radians(30.0));
    Planner planner({.technique = kPlainTechnique, .map_size = 1008, .border_texels = 4.0});
    const Plan& plan = world.plan(planner);
    const View& view = plan.views.at(0);
    EXPECT_FALSE(view.projection.orthographic);
    EXPECT_FALSE(view.projection.clamp_near); // what is nearer than the light's near distance does not cast
    const double tangent = std::tan(glm::radians(30.0));
    EXPECT_NEAR(view.projection.texel_m, 2.0 * tangent / 1000.0, 1e-9);
    EXPECT_EQ(view.projection.light_place_ws, glm::dvec3(0, 10, 0));
    EXPECT_NEAR(project(view, {10 * tangent, 0, 0}).x, 1000.0 / 1008.0, 1e-9);
    EXPECT_EQ(plan.casters, (std::vector<std::uint32_t>{1})); // the particle is above the light
    // The box's top is 7 m below the light, the floor 10 m.
    EXPECT_NEAR(view.projection.metric.near_m, 7.0, 0.01);
    EXPECT_NEAR(view.projection.metric.far_m, 10.0, 0.01);
    EXPECT_NEAR(glm::dot(view.projection.metric.metric_ws, glm::dvec4(3, 0, 2, 1)), 1.0, 1e-3);
}

TEST(UniformFit, WallThatPassesASpotCountsWhereTheConeMeetsIt)
{
    World world;
    world.set.remove(world.set.idAt(1));
    world.set.add({{2, 0, -10}, {2.5F, 30, 10}}); // beside the light, from under it to far above
    world.lights[0] = test::spot({0, 10, 0}, {0, -1, 0}, glm::radians(30.0));
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    const Plan& plan = world.plan(planner);
    const View& view = plan.views.at(0);
    EXPECT_EQ(plan.casters, (std::vector<std::uint32_t>{1}));
    // The cone is 2 m wide at 2 / tan(30 degrees) below the light.
    EXPECT_NEAR(view.projection.metric.near_m, 2.0 / std::tan(glm::radians(30.0)), 0.01);
}

TEST(UniformFit, SpotMapHoldsOnlyWhatIsSeen)
{
    World world;
    world.lights[0] = test::spot({0, 10, 0}, {0, -1, 0}, glm::radians(60.0));
    world.frame.camera = test::orthographicCamera({5, 500, 5}, {5, 0, 5}, 1.0);
    world.set.add({{2, 4, 2}, {3, 5, 3}}); // on the way there, and not seen
    Planner planner({.technique = kPlainTechnique, .map_size = 1008, .border_texels = 4.0});
    const View& view = world.plan(planner).views.at(0);
    // The floor from 4 to 6 m: tangents 0.4 to 0.6 (the body is 3 m high above it, which widens them to 6/7).
    EXPECT_LT(view.projection.texel_m, 0.0005);
    EXPECT_GT(view.projection.texel_m, 0.0001);
    for (const double x : {4.01, 5.99})
        for (const double z : {4.01, 5.99})
            EXPECT_LT(glm::length(glm::dvec2(project(view, {x, 0, z}))), 1.41);
}

TEST(UniformFit, MaxDistanceCutsTheReceivers)
{
    World world;
    world.frame.camera = test::perspectiveCamera({0, 2, 30}, {0, 1, 0}, 1.0);
    world.set.add({{0, 8, 7}, {1, 9, 8}}, {true, false, false});
    Planner all(ShadowOptions{.technique = kPlainTechnique});
    Planner near({.technique = kPlainTechnique, .max_distance_m = 25.0});
    const double whole = world.plan(all).views.at(0).projection.texel_xy_m.y;
    const Plan& cut = world.plan(near);
    EXPECT_LT(cut.views.at(0).projection.texel_xy_m.y, 0.5 * whole); // 5 of the 20 metres of floor are left
    EXPECT_EQ(cut.receivers, (std::vector<std::uint32_t>{0}));
    Planner nearest({.technique = kPlainTechnique, .max_distance_m = 5.0});
    EXPECT_EQ(world.plan(nearest).lights[0].outcome.kind, OutcomeKind::no_receiver);
}

TEST(Outcome, EachCanBeProvoked)
{
    EXPECT_EQ(World().outcome(), OutcomeKind::ok);
    World unwanted;
    unwanted.lights[0].casts_shadow = false;
    EXPECT_EQ(unwanted.outcome(), OutcomeKind::no_shadow_wanted);
    World away;
    away.frame.camera = test::perspectiveCamera({0, 5, 30}, {0, 5, 60}, 1.0);
    EXPECT_EQ(away.outcome(), OutcomeKind::no_receiver);
    World out_of_reach;
    out_of_reach.lights[0] = test::spot({0, 10, 0}, {0, -1, 0}, 0.5, 5.0);
    EXPECT_EQ(out_of_reach.outcome(), OutcomeKind::no_receiver);
    World alone;
    alone.set.remove(alone.set.idAt(1));
    alone.set.remove(alone.set.idAt(2));
    EXPECT_EQ(alone.outcome(), OutcomeKind::no_caster);
    alone.set.remove(alone.set.idAt(0));
    EXPECT_EQ(alone.outcome(), OutcomeKind::no_receiver);
    World refused;
    EXPECT_EQ(refused.outcome({.technique = {.partition = Partition::sdsm, .motion = Motion::snap}}),
              OutcomeKind::refused);
    EXPECT_EQ(refused.outcome({.technique = {.partition = Partition::cube}}), OutcomeKind::refused);
    refused.lights[0].type = LightType::point;
    EXPECT_EQ(refused.outcome({.technique = kPlainTechnique}), OutcomeKind::refused);
    refused.lights[0] = test::spot({0, 10, 0}, {0, -1, 0}, 1.2);
    EXPECT_EQ(refused.outcome({.technique = kPlainTechnique}), OutcomeKind::refused) << "no one frustum holds it";
    EXPECT_EQ(refused.outcome({.technique = {.partition = Partition::cube}}), OutcomeKind::ok);
    World full;
    full.lights.insert(full.lights.begin(), 2, test::sun({0, -1, 0}));
    Planner planner({.technique = kPlainTechnique, .map_size = 16, .max_layers = 2}); // smaller maps there are none
    EXPECT_EQ(full.plan(planner).lights[2].outcome.kind, OutcomeKind::atlas_full);
    EXPECT_EQ(full.plan(planner).pages[0].layers, 2U);
}

TEST(Outcome, ASunOfMoreThanAQuarterTurnIsDegenerate)
{
    for (const auto& [angle_rad, kind] : {std::pair{1.5707, OutcomeKind::ok}, std::pair{2.0, OutcomeKind::degenerate},
                                          std::pair{6.0, OutcomeKind::degenerate}}) {
        World world;
        world.lights[0].angular_diameter_rad = angle_rad;
        EXPECT_EQ(world.outcome(), kind) << angle_rad;
    }
}

TEST(Outcome, NumbersThatDescribeNothingAreDegenerate)
{
    const auto light = [](auto change) {
        World world;
        world.lights[0] = test::spot({0, 10, 0}, {0, -1, 0}, 0.5, 50.0);
        change(world.lights[0]);
        return world.outcome();
    };
    EXPECT_EQ(light([](Light&) {}), OutcomeKind::ok);
    EXPECT_EQ(light([](Light& l) { l.direction_ws = glm::dvec3(0.0); }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.direction_ws.x = kNan; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.position_ws.z = kNan; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.outer_half_angle_rad = 0.0; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.outer_half_angle_rad = kNan; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.range_m = -1.0; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.range_m = kNan; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.near_m = 60.0; }), OutcomeKind::degenerate);
    EXPECT_EQ(light([](Light& l) { l.near_m = -0.1; }), OutcomeKind::degenerate);
    World camera;
    camera.frame.camera.clip_from_world[1][2] = kNan;
    EXPECT_EQ(camera.outcome(), OutcomeKind::degenerate);
    camera.frame.camera.clip_from_world = glm::dmat4(0.0);
    EXPECT_EQ(camera.outcome(), OutcomeKind::degenerate);
    camera.frame.camera = test::orthographicCamera({0, 500, 0}, {0, 0, 0}, 50.0);
    camera.frame.camera.eye_ws.x = kNan;
    EXPECT_EQ(camera.outcome(), OutcomeKind::degenerate);
}

TEST(Plan, FourLightsShareAMaskLayer)
{
    World world;
    world.lights.resize(6, world.lights[0]);
    world.lights[1].casts_shadow = false;
    Planner planner({.technique = kPlainTechnique, .map_size = 64});
    const Plan& plan = world.plan(planner);
    EXPECT_EQ(plan.mask_layers, 2U);
    ASSERT_EQ(plan.lights.size(), 6U);
    for (std::uint32_t i = 0; i < 6; ++i) {
        EXPECT_EQ(plan.lights[i].mask_layer, i / 4);
        EXPECT_EQ(plan.lights[i].mask_channel, i % 4);
    }
    EXPECT_EQ(plan.pages[0].layers, 5U);
    EXPECT_EQ(plan.pages[0].width, 64U);
    EXPECT_EQ(plan.views.size(), 5U);
    EXPECT_EQ(plan.views[4].light, 5U);
    EXPECT_EQ(plan.lights[5].first_view, 4U);
    EXPECT_EQ(plan.views[4].place.tile.layer, 4U);
    world.lights.clear();
    EXPECT_EQ(world.plan(planner).mask_layers, 0U);
    EXPECT_EQ(world.plan(planner).pages[0].layers, 0U);
}

TEST(Plan, LightOutOfSightKeepsItsLayer)
{
    World world;
    world.lights.insert(world.lights.begin(), test::spot({0, 10, 0}, {0, -1, 0}, 0.5));
    Planner planner({.technique = kPlainTechnique, .map_size = 64});
    (void)world.plan(planner);
    world.lights[0].position_ws.x = 900.0;
    const Plan& plan = world.plan(planner);
    EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::no_receiver);
    ASSERT_EQ(plan.views.size(), 1U);
    EXPECT_EQ(plan.views[0].place.tile.layer, 1U);
    EXPECT_FALSE(plan.views[0].contents.redraw);
}

TEST(Redraw, OnlyWhenSomethingInTheMapChanged)
{
    World world;
    Planner planner({.technique = kPlainTechnique, .map_size = 64});
    const auto redraw = [&] {
        return world.plan(planner).views.at(0).contents.redraw;
    };
    EXPECT_TRUE(redraw());
    EXPECT_FALSE(redraw());
    world.set.touch(world.set.idAt(0)); // receives only
    EXPECT_FALSE(redraw());
    world.set.touch(world.set.idAt(1));
    EXPECT_TRUE(redraw());
    EXPECT_FALSE(redraw());
    world.set.update(world.set.idAt(2), {{4, 99, 4}, {5, 100, 5}});
    EXPECT_TRUE(redraw());
    EXPECT_FALSE(redraw());
    const ObjectId beside = world.set.add({{70, 1, 0}, {71, 2, 1}}, {true, false, false});
    EXPECT_FALSE(redraw());
    world.set.update(beside, {{7, 1, 0}, {8, 2, 1}});
    EXPECT_TRUE(redraw());
    world.set.remove(beside);
    EXPECT_TRUE(redraw());
    EXPECT_FALSE(redraw());
    world.frame.camera = test::orthographicCamera({3, 500, 0}, {3, 0, 0}, 9.0);
    EXPECT_TRUE(redraw());
    EXPECT_FALSE(redraw());
    world.lights[0] = test::sun({0.01, -1, 0});
    EXPECT_TRUE(redraw());
    planner.reset();
    EXPECT_TRUE(redraw());
    EXPECT_FALSE(redraw());
    world.lights.push_back(world.lights[0]); // the pages grow: what was drawn is still there
    EXPECT_FALSE(redraw());
    EXPECT_TRUE(world.plan(planner).views.size() == 2 && !world.plan(planner).views[1].contents.redraw);
    World other;
    other.lights = world.lights;
    other.frame.camera = world.frame.camera;
    EXPECT_TRUE(other.plan(planner).views.at(0).contents.redraw);
}

} // namespace
} // namespace gnomon
