// SPDX-License-Identifier: Apache-2.0
// The trapezoid: where its focus line lies in the map, and the paper's equation.
#include "fit_stage.h"

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

} // namespace
} // namespace gnomon
