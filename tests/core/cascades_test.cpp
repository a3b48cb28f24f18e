// SPDX-License-Identifier: Apache-2.0
// Where cascades end, that together they serve all that is seen, and that each of them has it in its map.
#define GNOMON_REAL double
#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>
#include <gnomon/shared/cascade_fit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using shared::practicalSplit;
using test::Random;

TEST(PracticalSplit, IsTheMeanOfBothRulesByLambda)
{
    // F. Zhang et al. 2006, eq. 3 to 5, for 1 .. 81 in four: 3, 9, 27 by the logarithm, 21, 41, 61 evenly.
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 1.0, 1, 4), 3.0, 1e-12);
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 1.0, 3, 4), 27.0, 1e-12);
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 0.0, 2, 4), 41.0, 1e-12);
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 0.5, 1, 4), 12.0, 1e-12);
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 0.75, 2, 4), 0.75 * 9.0 + 0.25 * 41.0, 1e-12);
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 0.75, 0, 4), 1.0, 1e-12);
    EXPECT_NEAR(practicalSplit(1.0, 81.0, 0.75, 4, 4), 81.0, 1e-12);
}

struct Ground {
    ObjectSet set;
    std::vector<Light> lights{test::sun({0.3, -1.0, 0.2})};
    Frame frame;

    Ground()
    {
        set.add(test::boxAt({0, -0.5, 0}, {200, 0.5, 200}), {true, true, false});
        for (int z = -180; z <= 180; z += 20)
            for (int x = -180; x <= 180; x += 20)
                set.add(test::boxAt({x, 2, z}, {1, 2, 1}), {true, true, false});
        frame.camera = test::perspectiveCamera({1.0, 1.7, 150.0}, {0.0, 1.0, 0.0}, 0.9);
        frame.lights = lights;
        frame.objects = &set;
    }
    Plan plan(ShadowOptions options) const { return Planner(options).plan(frame); }
};

ShadowOptions cascades(std::uint32_t count)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = Partition::cascades;
    options.cascades.count = count;
    options.map_size = 1024;
    return options;
}

TEST(Cascades, ShareTheViewWithOverlapsOnly)
{
    const Ground ground;
    const Plan plan = ground.plan(cascades(4));
    ASSERT_EQ(plan.views.size(), 4U);
    EXPECT_EQ(plan.pages[0].layers, 4U);
    for (std::size_t i = 0; i + 1 < plan.views.size(); ++i) {
        const ViewSlice& here = plan.views[i].serves.slice;
        const ViewSlice& next = plan.views[i + 1].serves.slice;
        EXPECT_GT(here.end_m, 0.0);
        EXPECT_GT(next.blend_m, 0.0);
        EXPECT_NEAR(next.begin_m + next.blend_m, here.end_m, 1e-9 * here.end_m);
        EXPECT_LT(plan.views[i].projection.texel_m, plan.views[i + 1].projection.texel_m);
    }
    EXPECT_FALSE(std::isfinite(plan.views.front().serves.slice.begin_m));
    EXPECT_FALSE(std::isfinite(plan.views.back().serves.slice.end_m));
}

TEST(Cascades, EndWhereTheyAreToldTo)
{
    ShadowOptions options = cascades(3);
    options.cascades.ends_m = {10.0, 40.0};
    options.cascades.blend = 0.0;
    const Plan plan = Ground().plan(options);
    ASSERT_EQ(plan.views.size(), 3U);
    EXPECT_EQ(plan.views[0].serves.slice.end_m, 10.0);
    EXPECT_EQ(plan.views[1].serves.slice.begin_m, 10.0);
    EXPECT_EQ(plan.views[1].serves.slice.end_m, 40.0);
    EXPECT_EQ(plan.views[2].serves.slice.begin_m, 40.0);
}

TEST(Cascades, OneIsAsGoodAsNone)
{
    const Ground ground;
    ShadowOptions single{.technique = kPlainTechnique};
    single.map_size = 1024;
    const Plan one = ground.plan(cascades(1));
    const Plan none = ground.plan(single);
    ASSERT_EQ(one.views.size(), 1U);
    // And a little better: it knows how near and how far there is something to see.
    EXPECT_LE(one.views[0].projection.texel_xy_m.x, none.views[0].projection.texel_xy_m.x);
    EXPECT_LE(one.views[0].projection.texel_xy_m.y, none.views[0].projection.texel_xy_m.y);
    EXPECT_LE(one.views[0].casters.count, none.views[0].casters.count);
    EXPECT_FALSE(one.views[0].serves.slice.bounded());
}

TEST(Cascades, TheFirstWarpIsRuledByWhatThereIsToSee)
{
    // From 30 m up, looking down by atan(1/2): a tower far off makes the box of all receivers reach up to the eye and
    // beyond, but the nearest thing in sight is at the picture's lower edge, the top of a box 4 m high.
    Ground ground;
    ground.set.add(test::boxAt({100, 30, -180}, {5, 30, 5}), {true, true, false});
    ground.frame.camera = test::perspectiveCamera({0, 30, 0}, {0, 0, -60}, 0.9);
    const double nearest_m = 26.0 / std::sin(std::atan(0.5) + 0.45) * std::cos(0.45);
    ShadowOptions options = cascades(2);
    options.technique.fit = Fit::lispsm;
    const Plan plan = ground.plan(options);
    ASSERT_EQ(plan.views.size(), 2U);
    const ViewSlice& first = plan.views[0].serves.slice;
    // LiSPSM gives both ends equal errors, w_f^2 / z_f = 1 / z_n; what stands on the ground widens the outline a
    // little. Ruled by the air before the eye it would be 12.
    EXPECT_LT(plan.views[0].fit.strength, 1.25 * std::sqrt(first.end_m / nearest_m));
    EXPECT_GT(plan.views[0].fit.strength, 1.0);
}

TEST(Cascades, OfAnOrthographicCameraAreEven)
{
    Ground ground;
    ground.frame.camera = test::orthographicCamera({0, 60, 100}, {0, 0, 0}, 60.0);
    ShadowOptions options = cascades(3);
    options.cascades.blend = 0.0;
    const Plan plan = ground.plan(options);
    ASSERT_EQ(plan.views.size(), 3U);
    const double first = plan.views[0].serves.slice.end_m;
    const double second = plan.views[1].serves.slice.end_m;
    // Lengths of the second and, by the even rule, of the first: what is seen begins at 2 first - second.
    double nearest = 1e9;
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p = random.inBox({-200, 0, -200}, {200, 0, 200});
        const glm::dvec4 c = ground.frame.camera.clip_from_world * glm::dvec4(p, 1.0);
        if (std::abs(c.x) < 1.0 && std::abs(c.y) < 1.0 && c.z > 0.0 && c.z < 1.0)
            nearest = std::min(nearest, glm::dot(plan.views[1].serves.slice.axis, glm::dvec4(p, 1.0)));
    }
    EXPECT_NEAR(2.0 * first - second, nearest, 0.1 * (second - first));
    // And with depth the other way round they are the same.
    glm::dmat4& clip = ground.frame.camera.clip_from_world;
    for (int column = 0; column < 4; ++column) {
        clip[column][2] = clip[column][3] - clip[column][2];
    }
    ground.frame.camera.reversed_z = true;
    const Plan reversed = ground.plan(options);
    ASSERT_EQ(reversed.views.size(), 3U);
    EXPECT_NEAR(reversed.views[0].serves.slice.end_m, first, 1e-6);
    EXPECT_NEAR(reversed.views[1].serves.slice.end_m, second, 1e-6);
}

TEST(ViewsTogether, AreThoseOfOneLightInConsecutiveLayersThatAreDrawnAtOnce)
{
    const Ground ground;
    const Plan plan = ground.plan(cascades(4));
    ASSERT_EQ(plan.views.size(), 4U);
    EXPECT_EQ(viewsTogether(plan, 0), 4U);
    EXPECT_EQ(viewsTogether(plan, 1), 3U);
    EXPECT_EQ(viewsTogether(plan, 3), 1U);
    const auto with = [&](auto change) {
        Plan changed = plan;
        change(changed.views[2]);
        return viewsTogether(changed, 0);
    };
    EXPECT_EQ(with([](View&) {}), 4U);
    EXPECT_EQ(with([](View& view) { view.contents.redraw = false; }), 2U);
    EXPECT_EQ(with([](View& view) { view.light = 1; }), 2U);
    EXPECT_EQ(with([](View& view) { view.serves.sun = SunPosition::later; }), 2U);
    EXPECT_EQ(with([](View& view) { view.contents.kept_layer = 0; }), 2U);
    EXPECT_EQ(with([](View& view) { view.place.part = TexelPart::first; }), 2U);
    EXPECT_EQ(with([](View& view) { ++view.place.tile.layer; }), 2U);
    EXPECT_EQ(with([](View& view) { ++view.place.tile.x; }), 2U);
    EXPECT_EQ(with([](View& view) { --view.place.tile.height; }), 2U);
    EXPECT_EQ(with([](View& view) { view.projection.orthographic = !view.projection.orthographic; }), 2U);
    EXPECT_EQ(with([](View& view) { view.projection.clamp_near = !view.projection.clamp_near; }), 2U);
    EXPECT_EQ(with([](View& view) { view.projection.gpu_cascade = 2; }), 2U);
}

TEST(ViewsTogether, OfAPlanThatIsDrawnWholeHoldViewsThatNeedNoDrawing)
{
    const Ground ground;
    Plan plan = ground.plan(cascades(4));
    plan.views[0].contents.redraw = false;
    plan.views[2].contents.redraw = false;
    EXPECT_EQ(viewsTogether(plan, 0), 1U);
    EXPECT_EQ(viewsTogether(plan, 1), 1U);
    EXPECT_EQ(viewsTogether(plan, 0, true), 4U);
}

TEST(ViewsTogether, AreAllCascadesThatTheGpuFits)
{
    const Ground ground;
    ShadowOptions options = cascades(6);
    options.technique.partition = Partition::sdsm;
    EXPECT_EQ(viewsTogether(ground.plan(options), 0), 6U);
}

} // namespace
} // namespace gnomon
