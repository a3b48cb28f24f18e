// SPDX-License-Identifier: Apache-2.0
// lispsm and lispsm-simple against their closed forms, and what these are for: the same error at both ends; and that a
// warp which loses is weakened or given up.
#include "fit/no_loss.h"
#include "fit_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace gnomon {
namespace {

using test::FitStage;
using test::levelGround;
using test::Stage;

constexpr double kFar_m = 200.0;

/// How large a texel is in the picture, along the middle line of the ground, up to a constant.
double errorAt(const View& view, double z_m)
{
    const glm::dmat2 steps = test::mapSteps(view, {0, 0, -z_m}, {0, 0, -1}, {1, 0, 0});
    return 1.0 / (glm::length(steps[0]) * z_m);
}

/// Depth at which the lower edge of a level picture meets the ground.
double nearGround_m()
{
    return 1.7 / std::tan(glm::radians(30.0));
}

TEST(FitLispsm, NIsThePapers)
{
    for (const double pitch_deg : {0.0, 10.0, 30.0}) {
        const double pitch = glm::radians(pitch_deg);
        const FitStage stage(levelGround(pitch));
        const Warp warp = fitLispsm(stage.input());
        ASSERT_TRUE(warp.warped());
        // The lower edge's ray meets the ground after 1.7 / sin(pitch + 30 degrees).
        const double near = 1.7 / std::sin(pitch + glm::radians(30.0)) * std::cos(glm::radians(30.0));
        const double sine = std::cos(pitch); // view against a light from straight above
        const double n = (near + std::sqrt(near * kFar_m)) / sine;
        EXPECT_NEAR(warp.n, n, 1e-3 * n) << pitch_deg;
        // Along the view, away from the viewer; and upright is the viewer's own line.
        EXPECT_NEAR(glm::dot(stage.space.right_ws, {0, 0, -1}) * warp.along.x +
                        glm::dot(stage.space.up_ws, {0, 0, -1}) * warp.along.y,
                    1.0, 1e-12);
        EXPECT_NEAR(warp.upright, 0.0, 1e-9);
    }
}

TEST(FitLispsm, BothEndsHaveTheSameError)
{
    Stage stage = levelGround();
    const Plan uniform = stage.plan(Fit::uniform);
    for (const Fit fit : {Fit::lispsm, Fit::lispsm_simple}) {
        const Plan plan = stage.plan(fit);
        ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
        const View& view = plan.views[0];
        const double near = errorAt(view, nearGround_m());
        EXPECT_NEAR(errorAt(view, 0.999 * kFar_m) / near, 1.0, 0.01) << nameOf(fit);
        for (double z = nearGround_m(); z < kFar_m; z *= 1.1)
            EXPECT_LT(errorAt(view, z), 1.01 * near) << z;
        EXPECT_LT(near, 0.3 * errorAt(uniform.views[0], nearGround_m()));
    }
    // Unwarped the near end is as much worse as it is nearer.
    EXPECT_NEAR(errorAt(uniform.views[0], nearGround_m()) / errorAt(uniform.views[0], 0.999 * kFar_m),
                0.999 * kFar_m / nearGround_m(), 0.1);
}

TEST(FitLispsm, ALampAboveTheGroundIsWarpedByTheSameRule)
{
    Stage stage = levelGround();
    stage.light = test::spot({0, 60, -60}, {0, -1, 0}, 0.9);
    const FitStage seen(stage);
    const Plan uniform = stage.plan(Fit::uniform);
    for (const Fit fit : {Fit::lispsm, Fit::lispsm_simple, Fit::tsm}) {
        const Plan plan = stage.plan(fit);
        ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
        // Over level ground 60 m below, both depths are those of a plane across the light.
        const double reach = 60.0 * std::tan(0.9);
        const double far = 60.0 + reach;
        if (fit != Fit::tsm) {
            const double n = (nearGround_m() + std::sqrt(nearGround_m() * far)) / 60.0;
            EXPECT_NEAR(fitFunction(fit)(seen.input()).n, n, 1e-3 * n);
            EXPECT_NEAR(errorAt(plan.views[0], 0.999 * far) / errorAt(plan.views[0], nearGround_m()), 1.0, 0.01);
        }
        EXPECT_LT(errorAt(plan.views[0], nearGround_m()), 0.5 * errorAt(uniform.views[0], nearGround_m()));
    }
}

TEST(FitLispsm, FadesIntoUniformWhereViewAndLightAlign)
{
    Stage stage;
    stage.set.add(test::boxAt({0, 0, 0}, {10, 2, 10}));
    double last = 1e9;
    for (double angle = 90.0; angle > 0.0; angle -= 1.0) {
        const double gamma = glm::radians(angle);
        stage.camera = test::perspectiveCamera(glm::dvec3(0, std::cos(gamma), std::sin(gamma)) * 40.0, {0, 0, 0}, 0.8);
        const Plan plan = stage.plan(Fit::lispsm);
        ASSERT_TRUE(plan.lights[0].outcome.hasMap());
        const double strength = plan.views[0].fit.strength;
        // The box is 20 m long, and 40 m away less its half diagonal at most.
        EXPECT_LE(strength, 1.0 + 20.0 * std::sin(gamma) / 50.0);
        EXPECT_LT(strength, last + 0.01) << angle;
        last = strength;
    }
    EXPECT_EQ(last, 1.0);
}

TEST(FitLispsm, ADuelIsDrawnAsUniformBitForBit)
{
    for (const Fit fit : {Fit::lispsm, Fit::tsm, Fit::lispsm_simple})
        for (const double sign : {1.0, -1.0}) {
            Stage stage;
            stage.set.add(test::boxAt({0, 0, 0}, {10, 2, 10}));
            stage.light = test::sun({0, sign, 0});
            stage.camera = test::perspectiveCamera({0, 40, 0}, {0, 0, 0}, 0.3, 1.6, 0.1, kFar_m);
            const Plan plan = stage.plan(fit);
            EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::fallback);
            EXPECT_NE(plan.lights[0].outcome.reason, "");
            EXPECT_EQ(plan.views[0].fit.strength, 1.0);
            const Plan uniform = stage.plan(Fit::uniform);
            EXPECT_EQ(uniform.lights[0].outcome.kind, OutcomeKind::ok);
            EXPECT_EQ(std::memcmp(&plan.views[0].projection.clip_from_world,
                                  &uniform.views[0].projection.clip_from_world, sizeof(glm::dmat4)),
                      0);
        }
}

TEST(FitLispsm, SaysWhyItDoesNotWarp)
{
    Stage stage = levelGround();
    stage.camera = test::orthographicCamera({0, 40, 40}, {0, 0, 0}, 20.0);
    for (const Fit fit : {Fit::lispsm, Fit::tsm, Fit::lispsm_simple, Fit::psm}) {
        const Plan plan = stage.plan(fit);
        EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::fallback);
        EXPECT_NE(plan.lights[0].outcome.reason.find("equally large"), std::string_view::npos);
    }
    stage.camera = test::perspectiveCamera({0, 40, 0}, {0, 0, 0}, 0.3);
    EXPECT_NE(stage.plan(Fit::lispsm).lights[0].outcome.reason.find("along the light"), std::string_view::npos);
}

TEST(FitLispsmSimple, WarpsGroundUnderLightFromBehindTheViewer)
{
    // The sun 8 degrees above the horizon, behind the viewer: to the angle that is nearly a duel.
    Stage stage = levelGround();
    stage.light = test::sun({0, -std::sin(glm::radians(8.0)), -std::cos(glm::radians(8.0))});
    const View simple = stage.plan(Fit::lispsm_simple).views[0];
    const View paper = stage.plan(Fit::lispsm).views[0];
    EXPECT_NEAR(errorAt(simple, 0.999 * kFar_m) / errorAt(simple, nearGround_m()), 1.0, 0.02);
    EXPECT_LT(paper.fit.strength, 1.5);
    EXPECT_GT(simple.fit.strength, 5.0);
    EXPECT_LT(errorAt(simple, nearGround_m()), 0.4 * errorAt(paper, nearGround_m()));
}

TEST(FitLispsm, IsTheSameFarFromTheOrigin)
{
    const FitStage home(levelGround());
    const FitStage away(levelGround(0.0, {8192, 0, -8192}));
    for (const Fit fit : {Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm}) {
        const Warp a = fitFunction(fit)(home.input());
        const Warp b = fitFunction(fit)(away.input());
        EXPECT_NEAR(b.n, a.n, 0.01 * a.n) << nameOf(fit); // the body grows with what a float may be off
        EXPECT_NEAR(glm::dot(a.along, b.along), 1.0, 1e-4) << nameOf(fit);
    }
}

TEST(FitNoLoss, AWarpThatGainsStaysAsItIs)
{
    const FitStage stage(levelGround());
    const Warp warp = fitLispsm(stage.input());
    ASSERT_TRUE(warp.warped());
    for (const double loss : {0.5, 1.0, kLossBegins}) {
        const Warp kept = weakened(stage.input(), warp, kWorth, loss);
        EXPECT_EQ(kept.n, warp.n);
        EXPECT_EQ(kept.outcome.kind, OutcomeKind::ok);
    }
}

TEST(FitNoLoss, AWarpFadesByWhatItGainsAndLoses)
{
    const FitStage stage(levelGround());
    const FitInput input = stage.input();
    const Warp warp = fitLispsm(input);
    const auto strengthOf = [&](const Warp& tried) {
        double most = 1.0;
        for (const glm::dvec2& q : input.outline) {
            most = std::max(most, tried.wAt(q));
        }
        return most;
    };
    const double own = strengthOf(warp);
    ASSERT_GT(own, 4.0);
    const double half_way = 0.5 * (kLossBegins + kLossEnds);
    EXPECT_NEAR(strengthOf(weakened(input, warp, kWorth, half_way)), std::sqrt(own), 1e-6 * own);
    EXPECT_NEAR(strengthOf(weakened(input, warp, std::sqrt(kWorth), 1.0)), std::sqrt(own), 1e-6 * own);
    // Nothing switches: a thousandth more makes little difference anywhere on the way.
    double last = own;
    for (double loss = 1.0; loss < 1.5; loss += 0.001) {
        const double now = strengthOf(weakened(input, warp, kWorth, loss));
        EXPECT_LE(now, last + 1e-9);
        EXPECT_GT(now, 0.97 * last);
        last = now;
    }
    EXPECT_NEAR(strengthOf(weakened(input, warp, kWorth, kLossEnds)), kLeastStrength, 1e-6);
    const Warp none = weakened(input, warp, 1.0, 1.0);
    EXPECT_FALSE(none.warped());
    EXPECT_EQ(none.outcome.kind, OutcomeKind::fallback);
    EXPECT_NE(none.outcome.reason, "");
}

/// The camera looks into a low sun over a meadow with trees: what is gained by a warp along the view is less than what
/// is lost by turning the map to it.
TEST(FitNoLoss, InADuelOverWhatStandsTheWarpFallsBack)
{
    Stage stage = levelGround(0.1);
    stage.light = test::sun({0.0, -0.3, 1.0});
    for (int i = -6; i <= 6; ++i) {
        stage.set.add(test::boxAt({12.0 * i, 4.0, -30.0 - 9.0 * std::abs(i)}, {1.5, 4.0, 1.5}));
    }
    const Plan uniform = stage.plan(Fit::uniform);
    const double area = uniform.views[0].projection.texel_xy_m.x * uniform.views[0].projection.texel_xy_m.y;
    for (const Fit fit : {Fit::lispsm, Fit::tsm, Fit::lispsm_simple}) {
        const Plan plan = stage.plan(fit);
        const View& view = plan.views[0];
        if (plan.lights[0].outcome.kind == OutcomeKind::fallback) {
            EXPECT_EQ(view.projection.clip_from_world, uniform.views[0].projection.clip_from_world) << nameOf(fit);
            continue;
        }
        EXPECT_LT(view.fit.finest_texel.x * view.fit.finest_texel.y, area) << nameOf(fit) << " gains somewhere";
    }
}

} // namespace
} // namespace gnomon
