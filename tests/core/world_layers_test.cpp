// SPDX-License-Identifier: Apache-2.0
// Layers of depth that are volumes of the world (Marinescu 2011, eq. 5).
#include "scene_memory.h"
#include "world_layers.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

using test::Random;

struct Map {
    ObjectSet set;
    std::vector<Light> lights{test::sun({0.5, -1.0, 0.25})};
    Frame frame;

    Map()
    {
        set.add({{-100, -1, -100}, {100, 0, 100}});
        for (int i = -9; i <= 9; ++i) {
            set.add(test::boxAt({10 * i, 1, 3 * i}, {1, 1, 1}));
            set.add(test::boxAt({9 * i, 40 + i, -3 * i}, {1, 1, 1}), {true, true, true});
        }
        frame.objects = &set;
        frame.lights = lights;
        look({0, 30, 60});
    }
    void look(const glm::dvec3& eye) { frame.camera = test::perspectiveCamera(eye, {0, 1, 0}, 0.8); }
};

ShadowOptions inWorld(std::vector<WorldLayer> layers, LayerAxis axis = LayerAxis::height)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::lvsm;
    options.map_size = 512;
    options.moments.placement = LayerPlacement::world;
    options.moments.layer_axis = axis;
    if (!layers.empty()) {
        options.moments.layers = static_cast<std::uint32_t>(layers.size());
        std::copy(layers.begin(), layers.end(), options.moments.world_layers.begin());
    }
    return options;
}

double depthAt(const View& view, const glm::dvec3& p)
{
    return glm::dot(view.projection.metric.metric_ws, glm::dvec4(p, 1.0));
}
/// Eq. 5 of the layer at a point of the world.
double scaled(const View& view, std::size_t layer, const glm::dvec3& p)
{
    const DepthSpan& span = view.serves.layers[layer];
    return (depthAt(view, p) - span.near) / (span.far - span.near);
}

TEST(WorldLayers, AreEquation5OfHeight)
{
    Map map;
    Planner planner(inWorld({{-1.0, 6.0}, {25.0, 60.0}}));
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        map.look(random.inBox({-60, 3, -60}, {60, 80, 60}));
        const Plan& plan = planner.plan(map.frame);
        ASSERT_EQ(plan.views.size(), 1U);
        const View& view = plan.views[0];
        const glm::dvec3 p = random.inBox({-80, -1, -80}, {80, 60, 80});
        // From the light, so what floats comes first, and depth falls as height grows.
        EXPECT_NEAR(scaled(view, 0, p), (60.0 - p.y) / 35.0, 1e-9);
        EXPECT_NEAR(scaled(view, 1, p), (6.0 - p.y) / 7.0, 1e-9);
        // It is metres along the ray still.
        const double range_m = view.projection.metric.far_m - view.projection.metric.near_m;
        EXPECT_NEAR((depthAt(view, p + map.lights[0].direction_ws) - depthAt(view, p)) * range_m, 1.0, 1e-9);
        EXPECT_EQ(view.serves.layers[2], DepthSpan{});
    }
}

TEST(WorldLayers, AreEquation5AlongTheLight)
{
    Map map;
    Planner planner(inWorld({{-30.0, 10.0}, {5.0, 90.0}}, LayerAxis::light));
    const View view = planner.plan(map.frame).views.at(0);
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = random.inBox({-80, -1, -80}, {80, 60, 80});
        const double d = glm::dot(map.lights[0].direction_ws, p);
        EXPECT_NEAR(scaled(view, 0, p), (d + 30.0) / 40.0, 1e-9);
        EXPECT_NEAR(scaled(view, 1, p), (d - 5.0) / 85.0, 1e-9);
    }
}

TEST(WorldLayers, OfALampAreMetresFromIt)
{
    Map map;
    map.lights = {test::spot({0, 50, 0}, {0.1, -1.0, 0.0}, 0.6)};
    map.frame.lights = map.lights;
    Planner by_height(inWorld({{-1.0, 6.0}, {25.0, 60.0}}));
    const Outcome outcome = by_height.plan(map.frame).lights[0].outcome;
    EXPECT_EQ(outcome.kind, OutcomeKind::refused);
    EXPECT_NE(outcome.reason.find("lvsm.axis=light"), std::string_view::npos);
    Planner along(inWorld({{2.0, 20.0}, {30.0, 60.0}}, LayerAxis::light));
    const View view = along.plan(map.frame).views.at(0);
    const glm::dvec3 p(3.0, 10.0, 1.0);
    const double d = glm::dot(map.lights[0].direction_ws, p - map.lights[0].position_ws);
    EXPECT_NEAR(scaled(view, 0, p), (d - 2.0) / 18.0, 1e-9);
}

TEST(WorldLayers, ALowSunHasEqualParts)
{
    Map map;
    map.lights = {test::sun({1.0, -0.1, 0.0})};
    map.frame.lights = map.lights;
    Planner planner(inWorld({{-1.0, 6.0}, {25.0, 60.0}}));
    const View view = planner.plan(map.frame).views.at(0);
    EXPECT_EQ(view.serves.layers[0], (DepthSpan{0.0, 0.5}));
    EXPECT_EQ(view.serves.layers[1], (DepthSpan{0.5, 1.0}));
}

TEST(WorldLayers, CanBeTheHostsFrameByFrame)
{
    Map map;
    Planner planner(inWorld({}));
    std::vector<WorldLayer> layers{{-1.0, 6.0}, {25.0, 60.0}};
    map.frame.layers = layers;
    (void)planner.plan(map.frame);
    (void)planner.plan(map.frame);
    EXPECT_FALSE(planner.plan(map.frame).views.at(0).contents.redraw);
    layers[0].high_m = 8.0;
    const View changed = planner.plan(map.frame).views.at(0);
    EXPECT_TRUE(changed.contents.redraw) << "what was drawn was drawn with other layers";
    EXPECT_NEAR(scaled(changed, 1, {0, 8, 0}), 0.0, 1e-9);
    layers = {{3.0, 6.0}, {2.0, 60.0}};
    EXPECT_EQ(planner.plan(map.frame).lights[0].outcome.kind, OutcomeKind::refused);
    layers = {{3.0, 6.0}};
    map.frame.layers = layers;
    EXPECT_EQ(planner.plan(map.frame).lights[0].outcome.kind, OutcomeKind::refused);
}

TEST(WorldLayers, AreFoundOnceAndPartGroundAndWhatFloats)
{
    Map map;
    Planner planner(inWorld({}));
    const View view = planner.plan(map.frame).views.at(0);
    const std::vector<WorldLayer> found = findLayers(map.set, 2);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].high_m, 2.0, 1e-6);
    EXPECT_NEAR(found[1].low_m, 30.0, 2.0);
    EXPECT_NEAR(scaled(view, 1, {0, found[0].high_m, 0}), 0.0, 1e-9);
    // Another camera, and something that falls: they are where they were.
    map.look({10, 4, 9});
    for (std::uint32_t object = 2; object < 20; object += 2) {
        map.set.update(map.set.idAt(object), test::boxAt({0, 20, 0}, {1, 1, 1}));
    }
    const View later = planner.plan(map.frame).views.at(0);
    EXPECT_NEAR(scaled(later, 1, {0, found[0].high_m, 0}), 0.0, 1e-9);
    Planner along(inWorld({}, LayerAxis::light));
    EXPECT_EQ(along.plan(map.frame).lights[0].outcome.kind, OutcomeKind::refused);
}

TEST(WorldLayers, FoundLayersCanAlwaysBeHad)
{
    Random random(7);
    for (int round = 0; round < 300; ++round) {
        ObjectSet set;
        const std::uint32_t objects = random.below(40);
        for (std::uint32_t i = 0; i < objects; ++i) {
            const double flat = round % 3 == 0 ? 0.0 : 50.0;
            set.add(test::boxAt(random.inBox({-9, -flat, -9}, {9, flat, 9}), glm::dvec3(random.uniform(0.0, 3.0))));
        }
        for (std::uint32_t count = 2; count <= kMaxDepthLayers; ++count) {
            const std::vector<WorldLayer> found = findLayers(set, count);
            EXPECT_EQ(found.size(), set.size() == 0 ? 0U : count);
            EXPECT_EQ(refusal(found).value_or(""), "") << round << " " << count;
        }
    }
}

TEST(WorldLayers, ThatCannotBeAreRefused)
{
    const auto reason = [](std::vector<WorldLayer> layers, auto change) {
        ShadowOptions options = inWorld(std::move(layers));
        change(options);
        return resolve(options).refusal;
    };
    const auto as_is = [](ShadowOptions&) {
    };
    EXPECT_EQ(reason({{0, 8}, {10, 90}}, as_is), "");
    EXPECT_EQ(reason({{0, 8}, {4, 90}, {80, 100}}, as_is), "");
    EXPECT_NE(reason({{0, 8}, {10, 10}}, as_is), "");
    EXPECT_NE(reason({{10, 90}, {0, 8}}, as_is), "");
    EXPECT_NE(reason({{0, 90}, {10, 50}}, as_is), "") << "one within the other";
    EXPECT_NE(reason({{0, 8}, {10, 2e6}}, as_is), "");
    EXPECT_NE(reason({{0, 8}, {10, std::nan("")}}, as_is), "");
    EXPECT_NE(reason({{0, 8}, {10, 90}}, [](ShadowOptions& o) { o.moments.layers = 3; }), "");
    EXPECT_NE(reason({{0, 0}, {10, 90}}, as_is), "");
    EXPECT_NE(reason({{0, 8}, {10, 90}}, [](ShadowOptions& o) { o.moments.metric = DepthMetricKind::z_over_w; }), "");
}

} // namespace
} // namespace gnomon
