// SPDX-License-Identifier: Apache-2.0
// Frames and lights that nobody means: each is degenerate with a sentence, or planned in numbers that can be drawn;
// none loops, and none reaches another light's maps.
#include "hostile_world.h"

#include <gnomon/option_table.h>

#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::test {
namespace {

TEST(HostilePlanner, OfNoOptionsOrMovedFromRefusesEveryLight)
{
    Meadow meadow;
    Planner none{std::span<const ShadowOptions>()};
    expectSound(meadow.plan(none), 2);
    EXPECT_EQ(meadow.plan(none).lights[1].outcome.reason, "the planner was made of no options");
    EXPECT_EQ(none.options(5).map_size, ShadowOptions{.technique = kPlainTechnique}.map_size);

    Planner planner({.map_size = 64});
    const Planner taken = std::move(planner);
    EXPECT_EQ(taken.options().map_size, 64U);
    planner.lost({});
    planner.reset();
    EXPECT_EQ(planner.options().map_size, ShadowOptions{.technique = kPlainTechnique}.map_size);
    const Plan& plan = meadow.plan(planner);
    expectSound(plan, 2);
    EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::refused);
    EXPECT_EQ(plan.lights[0].outcome.reason, "the planner was moved from");
}

TEST(HostilePlanner, LosesOnlyMapsThatThereAre)
{
    Meadow meadow;
    Planner planner({.map_size = 64});
    const MapId map = meadow.plan(planner).views.at(0).place.map;
    for (const MapId wrong : {MapId{}, MapId{map.index, map.generation + 1}, MapId{1U << 31, 0}}) {
        planner.lost(wrong);
    }
    EXPECT_FALSE(meadow.plan(planner).views[0].contents.redraw);
    planner.lost(map);
    EXPECT_TRUE(meadow.plan(planner).views[0].contents.redraw);
}

TEST(HostileFrame, WithoutObjectsIsDegenerate)
{
    Meadow meadow;
    meadow.frame.objects = nullptr;
    Planner planner({.map_size = 64});
    const Plan& plan = meadow.plan(planner);
    expectSound(plan, 2);
    EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::degenerate);
    EXPECT_EQ(plan.lights[0].outcome.reason, "the frame has no objects: Frame::objects is null");
}

/// Every number of a camera, one after the other, by every partition, fit and motion.
TEST(HostileFrame, CamerasOfAnyNumbersAreDegenerateOrSound)
{
    std::size_t degenerate = 0;
    std::size_t planned = 0;
    for (const Partition partition : {Partition::single, Partition::cascades, Partition::sdsm, Partition::automatic}) {
        for (const Motion motion : {Motion::free, Motion::snap}) {
            for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm, Fit::psm, Fit::automatic}) {
                Planner planner(
                    ShadowOptions{.technique = {partition, fit, Filter::pcf, Soften::none, motion}, .map_size = 64});
                for (int number = 0; number < 19; ++number) {
                    for (const double value : {kNotANumber, kWithoutEnd, -kWithoutEnd, 0.0, -0.0, kSmallest, 1e-200,
                                               -1.0, 1e9, 1e38, -1e150, 1e300}) {
                        Meadow meadow;
                        Camera& camera = meadow.frame.camera;
                        (number < 16 ? camera.clip_from_world[number / 4][number % 4] : camera.eye_ws[number - 16]) =
                            value;
                        SCOPED_TRACE(number * 100 + static_cast<int>(fit));
                        const Plan& plan = meadow.plan(planner);
                        expectSound(plan, 2);
                        degenerate += plan.lights[0].outcome.kind == OutcomeKind::degenerate ? 1 : 0;
                        planned += plan.views.size();
                        if (!std::isfinite(value)) {
                            EXPECT_FALSE(plan.lights[0].outcome.hasMap());
                        }
                    }
                }
            }
        }
    }
    EXPECT_GE(degenerate, 500U);
    EXPECT_GE(planned, 500U);
}

TEST(HostileFrame, FieldsOfViewAndPlanesOfAnySizeAreDegenerateOrSound)
{
    Planner planner({.technique = {.partition = Partition::cascades}, .map_size = 64});
    for (const double fov_rad : {0.0, -1.0, 1e-300, 3.14159265358979, 3.2, 1e9, kNotANumber, kWithoutEnd}) {
        for (const double near_m : {0.0, -1.0, kSmallest, 1e-30, 1e3, kNotANumber, kWithoutEnd}) {
            for (const double far_m : {0.0, -5.0, 1e3, 1e38, kNotANumber, kWithoutEnd}) {
                Meadow meadow;
                const double tangent = std::tan(0.5 * fov_rad);
                glm::dmat4 clip_from_view(0.0); // glm's own asserts on some of these
                clip_from_view[0][0] = 1.0 / (1.6 * tangent);
                clip_from_view[1][1] = -1.0 / tangent;
                clip_from_view[2][2] = near_m / (far_m - near_m);
                clip_from_view[2][3] = -1.0;
                clip_from_view[3][2] = far_m * near_m / (far_m - near_m);
                meadow.frame.camera.clip_from_world = clip_from_view * viewFrom({20, 25, 30}, {0, 0, 0});
                meadow.frame.size_px = {0, 0};
                expectSound(meadow.plan(planner), 2);
            }
        }
    }
}

/// The numbers of a light that may be hostile.
std::vector<double*> numbersOf(Light& light)
{
    return {&light.position_ws.x,
            &light.position_ws.y,
            &light.position_ws.z,
            &light.direction_ws.x,
            &light.direction_ws.y,
            &light.direction_ws.z,
            &light.range_m,
            &light.near_m,
            &light.radius_m,
            &light.outer_half_angle_rad,
            &light.angular_diameter_rad};
}

TEST(HostileLights, OfAnyNumbersAreDegenerateOrSoundAndLeaveTheOthersAlone)
{
    for (const Motion motion : {Motion::free, Motion::snap, Motion::step_blend}) {
        const ShadowOptions options{.technique = {Partition::single, Fit::uniform, Filter::pcf, Soften::none, motion},
                                    .map_size = 64};
        for (const LightType type : {LightType::directional, LightType::spot, LightType::point, LightType{77}}) {
            Meadow calm;
            Planner calm_planner(options);
            const View expected = calm.plan(calm_planner).views.at(0);
            for (std::size_t number = 0; number < 11; ++number) {
                for (const double value : {kNotANumber, kWithoutEnd, -kWithoutEnd, 0.0, -1.0, kSmallest, 1e-300, 1.6,
                                           3.2, 1e9, 1e38, 1e200, 1e308}) {
                    Meadow meadow;
                    meadow.lights[1].type = type;
                    *numbersOf(meadow.lights[1])[number] = value;
                    Planner planner(options);
                    for (int frame = 0; frame < 2; ++frame) {
                        const Plan& plan = meadow.plan(planner);
                        SCOPED_TRACE("number " + std::to_string(number) + " is " + std::to_string(value));
                        expectSound(plan, 2);
                        ASSERT_FALSE(plan.views.empty());
                        EXPECT_EQ(plan.views[0].projection.clip_from_world, expected.projection.clip_from_world);
                        EXPECT_EQ(plan.views[0].casters.count, expected.casters.count);
                    }
                }
            }
        }
    }
}

TEST(HostileLights, ThatAreNoLightSayWhy)
{
    const auto kindOf = [](const Light& light) {
        Meadow meadow;
        meadow.lights = {light};
        Planner planner({.map_size = 64});
        return meadow.plan(planner).lights.at(0).outcome.kind;
    };
    const Light lamp = spot({3, 20, 0}, {0, -1, 0}, 0.8);
    EXPECT_EQ(kindOf(lamp), OutcomeKind::ok);
    for (const double angle_rad : {kNotANumber, 0.0, -0.5, 1.6, 3.15, kWithoutEnd}) {
        Light light = lamp;
        light.outer_half_angle_rad = angle_rad;
        EXPECT_EQ(kindOf(light), OutcomeKind::degenerate) << angle_rad;
    }
    for (const double angle_rad : {1.1, 1.5707963267948966}) {
        Light light = lamp;
        light.outer_half_angle_rad = angle_rad;
        EXPECT_EQ(kindOf(light), OutcomeKind::ok) << angle_rad;
    }
    for (double Light::*const number : {&Light::radius_m, &Light::range_m, &Light::near_m}) {
        for (const double value : {kNotANumber, kWithoutEnd, -1.0}) {
            Light light = lamp;
            light.*number = value;
            EXPECT_EQ(kindOf(light), OutcomeKind::degenerate);
        }
    }
    Light dark = sun({0, -1, 0});
    dark.direction_ws = {0, 0, 0};
    EXPECT_EQ(kindOf(dark), OutcomeKind::degenerate);
    dark.direction_ws = {0, kNotANumber, 0};
    EXPECT_EQ(kindOf(dark), OutcomeKind::degenerate);
    dark = sun({0, -1, 0});
    dark.angular_diameter_rad = kNotANumber;
    EXPECT_EQ(kindOf(dark), OutcomeKind::degenerate);
}

/// By the motions that remember lights, too.
TEST(HostileLights, OfOneKeyEachHaveTheirOwnMaps)
{
    for (const Motion motion : {Motion::free, Motion::step_alternate}) {
        Meadow meadow;
        for (int i = 0; i < 6; ++i) {
            meadow.lights.push_back(sun({0.1 * i, -1, 0}));
        }
        for (Light& light : meadow.lights) {
            light.key = 7;
        }
        Planner planner(
            {.technique = {Partition::single, Fit::uniform, Filter::pcf, Soften::none, motion}, .map_size = 64});
        for (int frame = 0; frame < 4; ++frame) {
            meadow.frame.time_s = frame;
            const Plan& plan = meadow.plan(planner);
            expectSound(plan, meadow.lights.size());
            std::vector<std::uint32_t> maps;
            for (const View& view : plan.views) {
                maps.push_back(view.place.map.index);
            }
            std::ranges::sort(maps);
            EXPECT_EQ(std::ranges::adjacent_find(maps), maps.end());
            EXPECT_GE(plan.views.size(), meadow.lights.size());
            std::rotate(meadow.lights.begin(), meadow.lights.begin() + 3, meadow.lights.end());
        }
    }
}

TEST(HostileLights, AreManyAndMostFindNoRoom)
{
    Meadow meadow;
    Light lamp = meadow.lights[1];
    lamp.map_size = 16;
    meadow.lights.assign(100000, lamp);
    for (std::uint32_t i = 0; i < meadow.lights.size(); ++i) {
        meadow.lights[i].key = 100000 - i;
        meadow.lights[i].options = i % 2; // every other one names none
    }
    Planner planner({.map_size = 64, .max_layers = 4});
    for (int frame = 0; frame < 2; ++frame) {
        const Plan& plan = meadow.plan(planner);
        ASSERT_EQ(plan.lights.size(), 100000U);
        EXPECT_EQ(plan.views.size(), 64U); // 16 to each of 4 pages
        EXPECT_EQ(plan.lights[99998].outcome.kind, OutcomeKind::atlas_full);
        EXPECT_EQ(plan.lights[99999].outcome.kind, OutcomeKind::refused);
        EXPECT_EQ(plan.mask_layers, 25000U);
    }
}

TEST(HostileFrame, TimesOfAnyKindAreSound)
{
    for (const StepBy by : {StepBy::angle, StepBy::time}) {
        for (const Motion motion : {Motion::step_jump, Motion::step_band, Motion::step_alternate}) {
            Meadow meadow;
            ShadowOptions options{.technique = {Partition::single, Fit::uniform, Filter::pcf, Soften::none, motion},
                                  .map_size = 64};
            options.steps.by = by;
            Planner planner(options);
            double turn = 0.0;
            for (const double time_s : {0.0, kNotANumber, 1.0, kWithoutEnd, 2.0, -kWithoutEnd, 3.0, 1e308, -1e308, 4.0,
                                        kSmallest, 4.1, 4.2, 4.3}) {
                meadow.frame.time_s = time_s;
                turn += 0.003;
                meadow.lights[0].direction_ws = glm::normalize(glm::dvec3(turn, -1, 0.2));
                const Plan& plan = meadow.plan(planner);
                expectSound(plan, 2);
                EXPECT_TRUE(plan.lights[0].outcome.hasMap());
                EXPECT_TRUE(plan.lights[0].steps.share >= 0.0 && plan.lights[0].steps.share <= 1.0);
            }
        }
    }
}

/// All of it at once, whatever it may be.
TEST(HostileFrame, RandomNumbersAreDegenerateOrSound)
{
    Random random(12);
    const auto anyNumber = [&] {
        const double scale = std::pow(10.0, random.uniform(-40.0, 40.0));
        const double special[]{kNotANumber, kWithoutEnd, 0.0, kSmallest, 1e300};
        return random.below(40) == 0 ? special[random.below(5)] : scale * random.uniform(-1.0, 1.0);
    };
    std::size_t planned = 0;
    for (int i = 0; i < 400; ++i) {
        Meadow meadow;
        for (std::uint32_t change = random.below(6); change > 0; --change) {
            const glm::vec3 low(anyNumber(), anyNumber(), anyNumber());
            const glm::vec3 size(std::abs(anyNumber()), std::abs(anyNumber()), std::abs(anyNumber()));
            meadow.set.update(meadow.set.idAt(random.below(13)), {low, low + size});
        }
        for (std::uint32_t change = random.below(3); change > 0; --change) {
            *numbersOf(meadow.lights[random.below(2)])[random.below(11)] = anyNumber();
        }
        if (random.below(3) == 0) {
            meadow.frame.camera.clip_from_world[static_cast<int>(random.below(4))][static_cast<int>(random.below(4))] =
                anyNumber();
        }
        ShadowOptions options{.technique = kPlainTechnique};
        options.map_size = 64;
        for (const std::string_view choice : {"partition", "fit", "filter", "motion"}) {
            const OptionRow& row = *findOption(choice);
            const std::vector<std::string_view> names = row.choices();
            OptionValue name;
            name.text = names[random.below(static_cast<std::uint32_t>(names.size()))];
            if (row.set(options, name); !resolve(options)) {
                row.set(options, row.get(ShadowOptions{.technique = kPlainTechnique}));
            }
        }
        Planner planner(options);
        SCOPED_TRACE("round " + std::to_string(i));
        for (int frame = 0; frame < 2; ++frame) {
            const Plan& plan = meadow.plan(planner);
            expectSound(plan, 2);
            planned += plan.views.size();
        }
    }
    EXPECT_GE(planned, 100U);
}

} // namespace
} // namespace gnomon::test
