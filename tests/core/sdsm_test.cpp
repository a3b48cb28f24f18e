// SPDX-License-Identifier: Apache-2.0
// Plans for cascades that the GPU fits, and the arithmetic of their fit.
#define GNOMON_REAL double
#include "worlds.h"

#include <gnomon/planner.h>
#include <gnomon/shared/cascade_fit.h>

#include <gtest/gtest.h>

#include <string>

namespace gnomon {
namespace {

struct Meadow {
    ObjectSet set;
    std::vector<Light> lights{test::sun({0.3, -1.0, 0.2}), test::spot({5.0, 12.0, 60.0}, {0.1, -1.0, 0.1}, 0.6)};
    Frame frame;

    Meadow()
    {
        set.add(test::boxAt({0, -0.5, 0}, {200, 0.5, 200}), {true, true, false});
        for (int x = -60; x <= 60; x += 10)
            set.add(test::boxAt({x, 2, 60}, {1, 2, 1}), {true, true, false});
        frame.camera = test::perspectiveCamera({1.0, 3.0, 90.0}, {0.0, 0.0, 0.0}, 0.9);
        frame.lights = lights;
        frame.objects = &set;
    }
};

ShadowOptions optionsOf(Partition partition, Fit fit, std::uint32_t count = 3)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = partition;
    options.technique.fit = fit;
    options.cascades.count = count;
    options.map_size = 512;
    return options;
}

TEST(Sdsm, ListsTheMapOfASingleCascadeOnceForEach)
{
    const Meadow meadow;
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm}) {
        const ShadowOptions options = optionsOf(Partition::sdsm, fit);
        Planner planner(options);
        Planner single(optionsOf(Partition::cascades, fit, 1));
        const Plan& plan = planner.plan(meadow.frame);
        const Plan& base = single.plan(meadow.frame);
        ASSERT_EQ(base.views.size(), 2U);
        ASSERT_EQ(plan.views.size(), 6U);
        EXPECT_EQ(plan.options->front().cascades().count, 3U);
        for (std::uint32_t i = 0; i < 6; ++i) {
            const View& view = plan.views[i];
            const View& one = base.views[i / 3];
            EXPECT_EQ(view.projection.gpu_cascade, i % 3);
            EXPECT_EQ(view.place.tile.layer, i);
            EXPECT_EQ(view.projection.clip_from_world, one.projection.clip_from_world);
            EXPECT_EQ(view.projection.metric.metric_ws, one.projection.metric.metric_ws);
            EXPECT_EQ(view.casters.count, one.casters.count);
            EXPECT_EQ(view.casters.first, plan.views[i / 3 * 3].casters.first);
            EXPECT_FALSE(view.serves.slice.bounded());
            EXPECT_NEAR(glm::dot(view.serves.slice.axis, glm::dvec4(meadow.frame.camera.eye_ws, 1.0)), 0.0, 1e-9);
            EXPECT_EQ(one.projection.gpu_cascade, kNoIndex);
        }
        EXPECT_EQ(plan.casters.size(), base.casters.size());
    }
}

TEST(Sdsm, IsDrawnAgainEveryFrame)
{
    const Meadow meadow;
    Planner planner(optionsOf(Partition::sdsm, Fit::uniform));
    Planner single(optionsOf(Partition::single, Fit::uniform));
    (void)planner.plan(meadow.frame);
    (void)single.plan(meadow.frame);
    EXPECT_FALSE(single.plan(meadow.frame).views[0].contents.redraw);
    for (const View& view : planner.plan(meadow.frame).views)
        EXPECT_TRUE(view.contents.redraw);
}

TEST(Sdsm, CannotBeHeldStill)
{
    for (const Motion motion : {Motion::snap, Motion::step_jump, Motion::step_blend}) {
        const Technique technique{Partition::sdsm, Fit::uniform, Filter::pcf, Soften::none, motion};
        EXPECT_TRUE(refusal(LightType::directional, technique).has_value());
    }
    EXPECT_FALSE(refusal(LightType::spot, {.partition = Partition::sdsm}).has_value());
    EXPECT_TRUE(refusal(LightType::point, {.partition = Partition::sdsm}).has_value());
}

TEST(Sdsm, AFittedViewShowsItsPartOfTheBaseMap)
{
    const Meadow meadow;
    Planner planner(optionsOf(Partition::sdsm, Fit::lispsm));
    const View base = planner.plan(meadow.frame).views[0];
    FittedView found;
    found.scale = {4.0, 2.5};
    found.centre = {-0.25, 0.5};
    found.begin_m = 3.0;
    found.end_m = 9.0;
    found.blend_m = 1.0;
    const View view = viewAsFitted(base, found);
    for (const glm::dvec3& p : {glm::dvec3(0.0, 0.0, 60.0), {4.0, 1.0, 70.0}, {-20.0, 0.0, -50.0}}) {
        const glm::dvec4 b = base.projection.clip_from_world * glm::dvec4(p, 1.0);
        const glm::dvec4 v = view.projection.clip_from_world * glm::dvec4(p, 1.0);
        EXPECT_NEAR(v.x / v.w, (b.x / b.w + 0.25) * 4.0, 1e-12);
        EXPECT_NEAR(v.y / v.w, (b.y / b.w - 0.5) * 2.5, 1e-12);
        EXPECT_EQ(v.z, b.z);
        EXPECT_EQ(v.w, b.w);
    }
    EXPECT_DOUBLE_EQ(view.projection.texel_xy_m.x, base.projection.texel_xy_m.x / 4.0);
    EXPECT_DOUBLE_EQ(view.projection.texel_m,
                     std::max(base.projection.texel_xy_m.x / 4.0, base.projection.texel_xy_m.y / 2.5));
    EXPECT_EQ(view.serves.slice.begin_m, 3.0);
    EXPECT_EQ(view.serves.slice.end_m, 9.0);
    EXPECT_EQ(view.serves.slice.blend_m, 1.0);
}

TEST(AxisPlace, FillsTheTileButForTheBorder)
{
    // 100 texels with a border of 10: what was seen is four fifths of the map.
    const glm::dvec2 place = shared::axisPlace(0.1, 0.5, 100.0 / 80.0);
    EXPECT_NEAR((0.1 - place.y) * place.x, -0.8, 1e-12);
    EXPECT_NEAR((0.5 - place.y) * place.x, 0.8, 1e-12);
}

TEST(AxisPlace, IsNeitherCoarserThanTheBaseMapNorEndlesslyFine)
{
    EXPECT_EQ(shared::axisPlace(-0.9, 0.9, 1.25), glm::dvec2(1.0, 0.0));
    EXPECT_EQ(shared::axisPlace(1.0, -1.0, 1.25), glm::dvec2(1.0, 0.0)) << "nothing was seen";
    const glm::dvec2 point = shared::axisPlace(0.3, 0.3, 1.25);
    EXPECT_DOUBLE_EQ(point.x, 512.0);
    EXPECT_DOUBLE_EQ(point.y, 0.3);
}

TEST(SliceCounts, OnBothSidesOfARoundedEnd)
{
    EXPECT_TRUE(shared::sliceCounts(10.00009, 1.0, 10.0));
    EXPECT_FALSE(shared::sliceCounts(10.0002, 1.0, 10.0));
    EXPECT_TRUE(shared::sliceCounts(9.99991, 10.0, 20.0));
    EXPECT_FALSE(shared::sliceCounts(9.9998, 10.0, 20.0));
}

TEST(SpareRoom, IsAQuarterOfTheLongerSideAtMost)
{
    const glm::dvec4 seen(-0.4, -0.1, 0.4, 0.1);
    // A ray is as long along x as along y.
    EXPECT_EQ(shared::spareRoom(seen, {-0.5, -0.3, 0.45, 0.2}, {0.5, 0.5}), glm::dvec4(-0.5, -0.3, 0.45, 0.2));
    EXPECT_EQ(shared::spareRoom(seen, {-1.4, -1.1, 1.4, 1.1}, {1.0, 1.0}),
              glm::dvec4(-0.4 - 0.2, -0.1 - 0.2, 0.4 + 0.2, 0.1 + 0.2));
    // The base map is four times as wide as high in metres: here what is seen is as long along both axes.
    EXPECT_EQ(shared::spareRoom(seen, {-1.4, -4.1, 1.4, 4.1}, {1.0, 4.0}),
              glm::dvec4(-0.4 - 0.2, -0.1 - 0.8, 0.4 + 0.2, 0.1 + 0.8));
    EXPECT_EQ(shared::spareRoom(seen, seen, {0.0, 0.0}), seen) << "there are no rays";
}

} // namespace
} // namespace gnomon
