// SPDX-License-Identifier: Apache-2.0
// A map that moves by whole texels: what it shows of the world is, texel for texel, what it showed before.
#include "motion/steps.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace {

using test::Random;

struct Meadow {
    ObjectSet set;
    std::vector<Light> lights{test::sun(glm::normalize(glm::dvec3(0.4, -1.0, 0.3)))};
    glm::dvec3 origin;
    Frame frame;

    explicit Meadow(const glm::dvec3& at) : origin(at)
    {
        set.add(test::boxAt(origin + glm::dvec3(0, -0.5, 0), {400, 0.5, 400}), {true, true, false});
        for (int i = -19; i <= 19; ++i)
            for (int k = -19; k <= 19; ++k)
                set.add(test::boxAt(origin + glm::dvec3(20 * i, 1, 20 * k), {0.5, 1, 0.5}), {true, true, false});
        frame.lights = lights;
        frame.objects = &set;
    }
    void look(const glm::dvec3& eye, const glm::dvec3& toward)
    {
        frame.camera = test::perspectiveCamera(origin + eye, origin + eye + toward, 0.8, 1.6, 0.1, 60.0);
    }
};

ShadowOptions snapped(Partition partition = Partition::single)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.motion = Motion::snap;
    options.technique.partition = partition;
    options.map_size = 512;
    return options;
}

/// Where a point of the world is in the map, texels.
glm::dvec2 texelAt(const View& view, const glm::dvec3& p)
{
    const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(p, 1.0);
    return (glm::dvec2(c) / c.w * 0.5 + 0.5) * static_cast<double>(view.place.tile.width);
}

double fromWhole(const glm::dvec2& v)
{
    const glm::dvec2 off = glm::abs(v - glm::round(v));
    return std::max(off.x, off.y);
}

TEST(Steps, GoUpByA64thOfAPowerOfTwo)
{
    EXPECT_EQ(steppedUp(64.0), 64.0);
    EXPECT_EQ(steppedUp(std::nextafter(64.0, 100.0)), 64.0);
    EXPECT_EQ(steppedUp(64.001), 65.0);
    EXPECT_EQ(steppedUp(63.9), 64.0);
    for (double v = 1e-3; v < 1e6; v *= 1.01) {
        EXPECT_GE(steppedUp(v), v * (1.0 - 1e-8));
        EXPECT_LE(steppedUp(v), v * (1.0 + 1.0 / 64.0));
    }
}

TEST(Steps, OfARangeHoldIt)
{
    const SteppedRange range = steppedRange(-3.1, 8.2);
    EXPECT_EQ(range.low, -4.0);
    EXPECT_EQ(range.high, 10.0);
    const SteppedRange ratio = steppedRatio(0.9, 4.1);
    EXPECT_NEAR(ratio.low, std::exp2(-0.25), 1e-12);
    EXPECT_NEAR(ratio.high, std::exp2(2.25), 1e-12);
}

class Snap : public testing::TestWithParam<std::tuple<Partition, double>> {};

/// Near the world's origin and 10 km off: every view keeps its texels' size, and moves by whole ones, however the
/// camera moves and turns.
TEST_P(Snap, MovesByWholeTexels)
{
    const auto [partition, away_m] = GetParam();
    Meadow meadow(glm::dvec3(away_m, 0.0, -0.7 * away_m));
    Planner planner(snapped(partition));
    Random random(11);
    std::vector<View> first;
    int moved = 0;
    for (int step = 0; step < 60; ++step) {
        const double angle = 0.3 * std::sin(0.11 * step);
        const glm::dvec3 eye(0.37 * step, 1.7 + 0.01 * step, 0.11 * step);
        meadow.look(eye, {std::sin(angle), -0.08, -std::cos(angle)});
        const Plan& plan = planner.plan(meadow.frame);
        if (first.empty())
            first = plan.views;
        ASSERT_EQ(plan.views.size(), first.size());
        for (std::size_t v = 0; v < first.size(); ++v) {
            const View& now = plan.views[v];
            if (now.projection.texel_xy_m != first[v].projection.texel_xy_m) // a split in steps went on by one
                continue;
            const glm::dvec3 p = meadow.origin + random.inBox({-50, 0, -50}, {50, 5, 50});
            const glm::dvec2 shift = texelAt(now, p) - texelAt(first[v], p);
            ASSERT_LT(fromWhole(shift), 2e-6) << "step " << step << " view " << v;
            moved += glm::length(shift) > 0.5 ? 1 : 0;
        }
    }
    EXPECT_GT(moved, 20);
}

TEST_P(Snap, KeepsItsSizeWhileTheCameraTurns)
{
    const auto [partition, away_m] = GetParam();
    Meadow meadow(glm::dvec3(away_m, 0.0, -0.7 * away_m));
    Planner planner(snapped(partition));
    std::vector<glm::dvec2> sizes;
    for (int step = 0; step < 90; ++step) {
        const double angle = step * 0.0698;
        meadow.look({3, 1.7, 4}, {std::sin(angle), -0.08, -std::cos(angle)});
        const Plan& plan = planner.plan(meadow.frame);
        if (sizes.empty())
            for (const View& view : plan.views)
                sizes.push_back(view.projection.texel_xy_m);
        ASSERT_EQ(plan.views.size(), sizes.size());
        for (std::size_t v = 0; v < sizes.size(); ++v)
            EXPECT_EQ(plan.views[v].projection.texel_xy_m, sizes[v]) << "step " << step;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Snap,
                         testing::Combine(testing::Values(Partition::single, Partition::cascades),
                                          testing::Values(0.0, 1e4)));

/// A camera that moves by whole texels across the light: the map is the same image, moved.
TEST(SnapOfWholeTexels, ChangesTheMapByNothingElse)
{
    Meadow meadow(glm::dvec3(0.0));
    const ShadowOptions options = snapped();
    meadow.look({0, 1.7, 0}, {0, -0.08, -1});
    const Plan before = Planner(options).plan(meadow.frame);
    const View& a = before.views[0];
    // The step of the world that is (3, -2) texels: solved in the plane across the light.
    const glm::dmat4 rows = glm::transpose(a.projection.clip_from_world);
    const glm::dvec3 x = glm::dvec3(rows[0]);
    const glm::dvec3 y = glm::dvec3(rows[1]);
    const double texel = 2.0 / largestSide(options);
    const glm::dvec3 step = x * (3.0 * texel / glm::dot(x, x)) - y * (2.0 * texel / glm::dot(y, y));
    meadow.look(glm::dvec3(0, 1.7, 0) + step, {0, -0.08, -1});
    const Plan after = Planner(options).plan(meadow.frame);
    const View& b = after.views[0];
    EXPECT_EQ(b.projection.texel_xy_m, a.projection.texel_xy_m);
    EXPECT_EQ(b.projection.metric.metric_ws, a.projection.metric.metric_ws);
    const glm::dvec2 shift = texelAt(b, {5, 1, -7}) - texelAt(a, {5, 1, -7});
    EXPECT_NEAR(shift.x, -3.0, 1e-9);
    EXPECT_NEAR(shift.y, 2.0, 1e-9);
}

TEST(Snap, IsStillWhereTheCameraOnlyTurnsALittle)
{
    Meadow meadow(glm::dvec3(0.0));
    Planner planner(snapped());
    meadow.look({0, 1.7, 0}, {0, -0.08, -1});
    (void)planner.plan(meadow.frame);
    meadow.look({0, 1.7, 0}, {1e-6, -0.08, -1});
    EXPECT_FALSE(planner.plan(meadow.frame).views.at(0).contents.redraw);
}

TEST(Snap, SaysThatItDropsAWarp)
{
    Meadow meadow(glm::dvec3(0.0));
    ShadowOptions options = snapped();
    options.technique.fit = Fit::lispsm;
    meadow.look({0, 1.7, 0}, {0, -0.08, -1});
    const Plan plan = Planner(options).plan(meadow.frame);
    EXPECT_EQ(plan.lights.at(0).outcome.kind, OutcomeKind::fallback);
    EXPECT_TRUE(plan.views.at(0).projection.orthographic);
}

TEST(Snap, OfASpotShowsAllThatItLights)
{
    Meadow meadow(glm::dvec3(0.0));
    meadow.lights = {test::spot({0, 20, -10}, {0, -1, 0}, 0.6, 60.0)};
    meadow.frame.lights = meadow.lights;
    Planner planner(snapped());
    meadow.look({0, 1.7, 0}, {0, -0.08, -1});
    (void)planner.plan(meadow.frame);
    meadow.look({4, 1.7, 2}, {0.3, -0.1, -1});
    const Plan& plan = planner.plan(meadow.frame);
    ASSERT_EQ(plan.views.size(), 1U);
    EXPECT_FALSE(plan.views[0].contents.redraw);
}

} // namespace
} // namespace gnomon
