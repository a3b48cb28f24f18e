// SPDX-License-Identifier: Apache-2.0
// Properties of every plan, tried on random scenes, cameras and lights, awkward ones included.
#include "plan_judge.h"
#include "random_scenes.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

namespace gnomon {
namespace {

using test::Awkward;
using test::Random;
using test::RandomScene;
using test::randomScene;
using test::Tally;

constexpr int kScenes = 1000;
constexpr int kManyScenes = 10000;

/// From each position of a sun that moves in steps the maps are right, for a light that shines from there.
TEST(PlanPropertiesOfSteps, HoldForEachPosition)
{
    Tally tally;
    int pairs = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        RandomScene scene = randomScene(
            seed, {Partition::single, Fit::uniform, Filter::pcf, Soften::none, static_cast<Motion>(2 + seed % 4)});
        if (seed % 3 == 0)
            scene.options.format = MapFormat::rg16; // two maps a texel
        Planner planner(scene.options);
        Frame frame = scene.frame();
        Random random(seed + 1000000);
        glm::dvec3 aside = glm::cross(scene.lights[0].direction_ws, glm::dvec3(0.3, 0.5, 0.8));
        for (int step = 0; step < 3; ++step) {
            scene.lights[0].direction_ws = glm::normalize(scene.lights[0].direction_ws + aside * 0.002);
            frame.lights = scene.lights;
            const Plan& plan = planner.plan(frame);
            for (const bool later : {false, true}) {
                // As a plan of one sun alone, whose only views are those of this position.
                const SunSteps& steps = plan.lights[0].steps;
                if ((later && !steps.paired) || !plan.lights[0].outcome.hasMap())
                    continue;
                const SunPosition sun = !steps.paired ? SunPosition::only
                                        : later       ? SunPosition::later
                                                      : SunPosition::earlier;
                const std::span<const View> views = viewsOf(plan, 0, sun);
                if (views.empty())
                    continue; // nothing casts from there
                Plan one = plan;
                one.lights.resize(1);
                one.lights[0].first_view = static_cast<std::uint32_t>(views.data() - plan.views.data());
                one.lights[0].view_count = static_cast<std::uint32_t>(views.size());
                RandomScene at = {.set = {},
                                  .camera = scene.camera,
                                  .lights = {scene.lights[0]},
                                  .options = scene.options,
                                  .size_m = scene.size_m};
                for (std::uint32_t object = 0; object < scene.set.size(); ++object)
                    at.set.add(scene.set.bounds(object), scene.set.flags(object));
                at.lights[0].direction_ws = later ? steps.later_ws : steps.earlier_ws;
                pairs += later ? 1 : 0;
                ASSERT_NO_FATAL_FAILURE(judge(at, one, random, tally));
            }
        }
    }
    EXPECT_GT(pairs, 300);
    EXPECT_GT(tally.seen, 5000);
    EXPECT_GT(tally.blocked, 3000);
}

/// Pieces of one trapezoid serve all that it would, suns' and lamps'.
TEST(PlanPropertiesOfSegments, HoldForRandomScenes)
{
    Tally tally;
    std::size_t divided = 0;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        RandomScene scene = randomScene(seed, {Partition::single, Fit::tsm, Filter::pcf, Soften::none, Motion::free});
        scene.options.tsm_segments = static_cast<std::uint32_t>(2 + seed % (kMaxCascades - 1));
        Planner planner(scene.options);
        const Plan& plan = planner.plan(scene.frame());
        for (const LightPlan& light : plan.lights) {
            ASSERT_LE(light.view_count, scene.options.tsm_segments);
            divided += light.view_count > 1 ? 1 : 0;
        }
        Random random(seed + 1000000);
        ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
    }
    EXPECT_GT(divided, 2000U);
    EXPECT_GT(tally.seen, 30000);
    EXPECT_GT(tally.blocked, 30000);
    EXPECT_EQ(tally.warped, 0);
}

class PlanProperties : public testing::TestWithParam<Technique> {};

/// Maps keep their places, so those that come and go with what is seen lie where earlier frames left room.
std::string bytesWithoutPlaces(Plan plan)
{
    for (View& view : plan.views)
        view.place.tile = {0, 0, 0, view.place.tile.width, view.place.tile.height};
    for (auto& page : plan.pages)
        page = {};
    return test::bytesOf(plan);
}

/// A planner that has seen other frames, and a scene made anew, give the same bits of the plan.
void checkSameBits(const RandomScene& scene, std::uint64_t seed, const Plan& plan)
{
    const RandomScene again = randomScene(seed, scene.options.technique);
    Planner used(again.options);
    if (seed % 4 == 0) {
        Frame other = again.frame();
        other.camera = test::perspectiveCamera({1, 2, 3}, {4, 5, 6}, 1.0);
        (void)used.plan(other);
        used.reset();
    }
    const Plan& same = used.plan(again.frame());
    const bool moves = scene.options.technique.partition == Partition::multi && seed % 4 == 0;
    ASSERT_TRUE(moves ? bytesWithoutPlaces(plan) == bytesWithoutPlaces(same)
                      : test::bytesOf(plan) == test::bytesOf(same));
}

void checkRandomScenes(const Technique& technique, int scenes)
{
    Tally tally;
    for (int seed = 1; seed <= scenes; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomScene scene = randomScene(seed, technique);
        Planner planner(scene.options);
        const Plan& plan = planner.plan(scene.frame());
        Random random(seed + 1000000);
        ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
        ASSERT_NO_FATAL_FAILURE(checkSameBits(scene, seed, plan));
    }
    // The sum of it must not be empty praise.
    EXPECT_GT(tally.seen, 15 * scenes);
    EXPECT_GT(tally.blocked, 15 * scenes);
    EXPECT_GT(tally.count(OutcomeKind::ok) + tally.count(OutcomeKind::fallback), scenes / 2);
    EXPECT_GT(tally.count(OutcomeKind::no_receiver), scenes / 30);
    const bool around = technique.partition == Partition::cube || technique.partition == Partition::paraboloid;
    // Around a point light there is hardly ever nothing that casts.
    EXPECT_GT(tally.count(OutcomeKind::no_caster), scenes / (around ? 200 : 100));
    EXPECT_EQ(tally.count(OutcomeKind::degenerate), 0);
    for (int i = 0; i < test::kAwkwardCount; ++i) {
        EXPECT_GT(tally.seen_awkward[i], scenes / 100) << nameOf(static_cast<Awkward>(i));
        EXPECT_GT(tally.blocked_awkward[i], scenes / 100) << nameOf(static_cast<Awkward>(i));
    }
    if (technique.fit == Fit::uniform) {
        EXPECT_EQ(tally.warped, 0);
        EXPECT_EQ(tally.count(OutcomeKind::fallback), 0);
    } else {
        EXPECT_GT(tally.warped, scenes / 6);
        if (technique.fit == Fit::automatic) { // to draw without a warp is its choice
            EXPECT_EQ(tally.count(OutcomeKind::fallback), 0);
        } else {
            EXPECT_GT(tally.count(OutcomeKind::fallback), scenes / 6);
        }
    }
}

TEST_P(PlanProperties, HoldForRandomScenes)
{
    checkRandomScenes(GetParam(), kScenes);
}

TEST_P(PlanProperties, HoldForManyRandomScenes)
{
    checkRandomScenes(GetParam(), kManyScenes);
}

/// Partition auto takes other maps, so a used planner's have other names; all else holds.
void checkRandomScenesOfAuto(int scenes)
{
    Tally tally;
    std::map<Partition, int> taken;
    for (const Motion motion : {Motion::free, Motion::snap})
        for (int seed = 1; seed <= scenes; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            const Technique technique{
                .partition = Partition::automatic, .fit = Fit::automatic, .filter = Filter::pcf, .motion = motion};
            const RandomScene scene = randomScene(seed, technique);
            Planner planner(scene.options);
            const Plan& plan = planner.plan(scene.frame());
            Random random(seed + 1000000);
            ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
            Planner again(scene.options);
            ASSERT_EQ(test::bytesOf(plan), test::bytesOf(again.plan(scene.frame())));
            for (const LightPlan& light : plan.lights)
                taken[light.choice.made ? light.choice.partition : Partition::automatic] += 1;
        }
    EXPECT_GT(tally.seen, 15 * scenes);
    EXPECT_GT(tally.blocked, 15 * scenes);
    EXPECT_GT(taken[Partition::single], scenes / 10);
    EXPECT_GT(taken[Partition::cascades], 0);
    EXPECT_EQ(taken[Partition::sdsm], 0);
}

TEST(PlanPropertiesOfAuto, HoldForRandomScenes)
{
    checkRandomScenesOfAuto(kScenes);
}

TEST(PlanPropertiesOfAuto, HoldForManyRandomScenes)
{
    checkRandomScenesOfAuto(kManyScenes);
}

/// The bytes above are a list of what a plan says; its JSON is another.
TEST_P(PlanProperties, SameInputSameJson)
{
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const RandomScene one = randomScene(seed, GetParam());
        const RandomScene two = randomScene(seed, GetParam());
        EXPECT_EQ(toJson(Planner(one.options).plan(one.frame())), toJson(Planner(two.options).plan(two.frame())));
    }
}

std::vector<Technique> allFits(Partition partition, Filter filter)
{
    std::vector<Technique> techniques;
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm, Fit::automatic})
        techniques.push_back({.partition = partition, .fit = fit, .filter = filter});
    return techniques;
}

std::string fitOf(const testing::TestParamInfo<Technique>& technique)
{
    std::string name(nameOf(technique.param.fit));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Fits, PlanProperties, testing::ValuesIn(allFits(Partition::single, Filter::pcf)), fitOf);
INSTANTIATE_TEST_SUITE_P(FitsOfCascades, PlanProperties, testing::ValuesIn(allFits(Partition::cascades, Filter::hard)),
                         fitOf);
INSTANTIATE_TEST_SUITE_P(FitsOfSdsm, PlanProperties, testing::ValuesIn(allFits(Partition::sdsm, Filter::hard)), fitOf);
INSTANTIATE_TEST_SUITE_P(FitsOfMulti, PlanProperties, testing::ValuesIn(allFits(Partition::multi, Filter::hard)),
                         fitOf);
INSTANTIATE_TEST_SUITE_P(Paraboloid, PlanProperties,
                         testing::Values(Technique{Partition::paraboloid, Fit::uniform, Filter::hard},
                                         Technique{Partition::paraboloid, Fit::uniform, Filter::pcf}),
                         [](const auto& technique) { return std::string(nameOf(technique.param.filter)); });
INSTANTIATE_TEST_SUITE_P(FitsOfCube, PlanProperties, testing::ValuesIn(allFits(Partition::cube, Filter::hard)), fitOf);
// Maps of filterable texels are not clamped at the near plane, hold receivers too and measure depth otherwise.
INSTANTIATE_TEST_SUITE_P(
    FitsOfFilterable, PlanProperties,
    testing::Values(Technique{.partition = Partition::single, .fit = Fit::uniform, .filter = Filter::evsm},
                    Technique{.partition = Partition::single, .fit = Fit::lispsm_simple, .filter = Filter::evsm}),
    fitOf);
INSTANTIATE_TEST_SUITE_P(
    Snap, PlanProperties,
    testing::Values(Technique{Partition::single, Fit::uniform, Filter::hard, Soften::none, Motion::snap},
                    Technique{Partition::single, Fit::uniform, Filter::evsm, Soften::none, Motion::snap},
                    Technique{Partition::cascades, Fit::uniform, Filter::pcf, Soften::none, Motion::snap},
                    Technique{Partition::cube, Fit::uniform, Filter::evsm, Soften::none, Motion::snap},
                    Technique{Partition::multi, Fit::uniform, Filter::hard, Soften::none, Motion::snap}),
    [](const auto& technique) {
        return std::string(nameOf(technique.param.partition)) + "_" + std::string(nameOf(technique.param.filter));
    });

} // namespace
} // namespace gnomon
