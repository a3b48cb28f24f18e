// SPDX-License-Identifier: Apache-2.0
// The trapezoid: where its focus line lies in the map, and the paper's equation.
#include "fit_stage.h"

#include "fit/tsm_segments.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using test::FitStage;
using test::levelGround;

TEST(FitTsm, TheFocusRegionHasFourFifthsOfTheMap)
{
    test::Stage stage = levelGround();
    const Plan plan = stage.plan(Fit::tsm);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
    const double near = 1.7 / std::tan(glm::radians(30.0));
    const double focus = std::pow(near, 0.2) * std::pow(200.0, 0.8);
    const double inner = 1.0 - 2.0 * resolvedOrThrow(stage.options).border_texels() / largestSide(stage.options);
    // Near is at y = 1, the end of what is seen at y = -1, both less the border.
    const auto yAt = [&](double z) {
        return test::mapPlace(plan.views[0], {0, 0, -z}).y / inner;
    };
    EXPECT_NEAR(yAt(near), 1.0, 1e-3);
    EXPECT_NEAR(yAt(200.0), -1.0, 1e-3);
    EXPECT_NEAR(yAt(focus), -0.6, 1e-3);
}

TEST(FitTsm, NIsThePapersEta)
{
    const FitStage stage(levelGround());
    const Warp warp = fitTsm(stage.input());
    const double near = 1.7 / std::tan(glm::radians(30.0));
    const double lambda = 200.0 - near;
    const double delta = std::pow(near, 0.2) * std::pow(200.0, 0.8) - near;
    const double xi = -0.6;
    const double eta = (lambda * delta + lambda * delta * xi) / (lambda - 2.0 * delta - lambda * xi);
    EXPECT_NEAR(warp.n, eta, 1e-3 * eta);
}

TEST(FitTsm, FadesWhereAllIsAboutEquallyFar)
{
    // A stretch of ground ever farther from the viewer.
    double last = 1e9;
    for (double away = 10.0; away < 1000.0; away *= 1.5) {
        test::Stage stage;
        stage.set.add(test::boxAt({0, 0, -away}, {5, 0, 5}));
        stage.set.add(test::boxAt({0, 1, -away}, {1, 1, 1}), {true, false, false});
        stage.camera = test::perspectiveCamera({0, 2, 0}, {0, 2, -1}, 1.0, 1.6, 0.1, 2000.0);
        const double strength = stage.plan(Fit::tsm).views[0].fit.strength;
        EXPECT_LE(strength, last);
        last = strength;
    }
    EXPECT_LT(last, 1.02);
}

/// However little the camera leans: what is equally far wants no warp.
TEST(FitTsm, HasNoWarpWhereAllIsEquallyFar)
{
    for (double lean = 1e-8; lean < 1e-3; lean *= 3.0) {
        test::Stage stage;
        stage.set.add(test::boxAt({0, 0, 0}, {5, 0, 5}));
        stage.camera = test::perspectiveCamera({0, 300, 300 * lean}, {0, 0, 0}, 0.1, 1.6, 0.1, 2000.0);
        EXPECT_FALSE(fitTsm(FitStage(stage).input()).warped()) << lean;
    }
}

/// Texels a pixel at the near end of a segment, up to a constant: alike in all of them.
double errorOf(double near, double slope, double widening, double a, double b)
{
    return std::sqrt((b - a) * (1.0 + widening * b)) / (near + slope * a);
}

TEST(FitTsm, SegmentsErrAlikeAndLessThanFewer)
{
    const FitStage stage(levelGround());
    const FitInput input = stage.input();
    const Warp warp = fitTsm(input);
    const double near = 1.7 / std::tan(glm::radians(30.0));
    double last = errorOf(near, 1.0, 1.0 / warp.n, 0.0, 200.0 - near);
    for (std::uint32_t count = 2; count <= 6; ++count) {
        const std::vector<double> ends = segmentTsm(input, count).ends;
        ASSERT_EQ(ends.size(), count + 1);
        const double first = errorOf(near, 1.0, 1.0 / warp.n, 0.0, ends[1] - ends[0]);
        for (std::uint32_t i = 0; i < count; ++i) {
            const double error = errorOf(near, 1.0, 1.0 / warp.n, ends[i] - ends[0], ends[i + 1] - ends[0]);
            EXPECT_NEAR(error, first, 2e-3 * first) << count << " segments, " << i;
        }
        EXPECT_LT(first, 0.9 * last) << count;
        last = first;
    }
}

TEST(FitTsm, SegmentsAreEvenWhereNothingIsNear)
{
    test::Stage stage;
    stage.set.add(test::boxAt({0, 0, 0}, {5, 0, 5}));
    stage.camera = test::perspectiveCamera({0, 300, 0.001}, {0, 0, 0}, 0.1, 1.6, 0.1, 2000.0);
    const FitStage fit(stage); // the camera looks along the light
    const TsmSegments found = segmentTsm(fit.input(), 4);
    ASSERT_EQ(found.ends.size(), 5U);
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(found.ends[i + 1] - found.ends[i], 0.25 * (found.ends[4] - found.ends[0]), 1e-4);
    }
}

TEST(FitTsm, SegmentsAreMapsOfOneTurnWhoseNearTexelsAreFinest)
{
    test::Stage stage = levelGround();
    stage.options.tsm_segments = 4;
    const Plan plan = stage.plan(Fit::tsm);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
    ASSERT_GE(plan.views.size(), 3U); // the last may have no caster
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        EXPECT_TRUE(view.projection.orthographic);
        EXPECT_EQ(view.serves.slice.axis, plan.views[0].serves.slice.axis);
        EXPECT_TRUE(i == 0 || view.projection.texel_m > plan.views[i - 1].projection.texel_m);
    }
}

TEST(FitTsm, SegmentsAreRefusedWhereNobodyCouldDivide)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.fit = Fit::tsm;
    options.tsm_segments = 4;
    EXPECT_TRUE(resolve(options));
    options.technique.partition = Partition::cascades;
    EXPECT_NE(resolve(options).refusal.find("tsm.segments"), std::string::npos);
    options.technique.partition = Partition::single;
    options.technique.motion = Motion::snap;
    EXPECT_NE(resolve(options).refusal.find("tsm.segments"), std::string::npos);
    options.technique.fit = Fit::uniform; // then it means nothing
    EXPECT_TRUE(resolve(options));
    EXPECT_EQ(resolve(options)->segments(), 1U);
}

} // namespace
} // namespace gnomon
