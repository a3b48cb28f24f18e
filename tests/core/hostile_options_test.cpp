// SPDX-License-Identifier: Apache-2.0
// Options that nobody means: each is refused with a sentence that names the row, or planned in numbers that can be
// drawn.
#include "hostile_world.h"

#include <gnomon/option_table.h>

namespace gnomon::test {
namespace {

OptionValue valueOf(double number)
{
    OptionValue value;
    value.real = number;
    value.numbers = {number};
    value.integer = !(std::abs(number) < 9e18) ? std::numeric_limits<std::int64_t>::max() * (number < 0 ? -1 : 1)
                                               : static_cast<std::int64_t>(number);
    return value;
}

bool hasRange(const OptionRow& row)
{
    return row.type == OptionType::integer || row.type == OptionType::real || row.type == OptionType::numbers;
}

/// A row's values that it must not take. Integers beyond 32 bits are among them, whose lower bits may be legal.
std::vector<double> illegalValues(const OptionRow& row)
{
    const double step = row.type == OptionType::integer ? 1.0 : 1e-3 * (row.max - row.min);
    std::vector<double> values{row.min - step, row.max + step, -1e30, 1e30, 4294967296.0 + row.min + 4294967296.0};
    if (row.type != OptionType::integer) {
        values.insert(values.end(), {kNotANumber, kWithoutEnd, -kWithoutEnd});
    }
    std::erase_if(values, [&](double value) { return value >= row.min && value <= row.max; });
    return values;
}

std::string saidOf(const OptionRow& row, double value)
{
    return std::string(row.key) + "=" + textOf(row, valueOf(value));
}

/// Tries every row, and so future ones as well.
TEST(HostileOptions, EveryRowBeyondItsRangeIsRefused)
{
    std::size_t tried = 0;
    for (const OptionRow& row : optionTable()) {
        if (!hasRange(row)) {
            continue;
        }
        for (const double value : illegalValues(row)) {
            const std::string said = saidOf(row, value);
            ShadowOptions options{.technique = kPlainTechnique};
            row.set(options, valueOf(value));
            if (row.get(options).none) {
                continue; // 0 may stand for no value
            }
            const Resolution resolution = resolve(options);
            ASSERT_FALSE(resolution) << said;
            EXPECT_EQ(resolution.refusal.substr(0, row.key.size()), row.key) << said;
            Meadow meadow;
            Planner planner(options);
            const Plan& plan = meadow.plan(planner);
            expectSound(plan, 2);
            for (const LightPlan& light : plan.lights) {
                EXPECT_EQ(light.outcome.kind, OutcomeKind::refused) << said;
                EXPECT_EQ(light.outcome.reason, resolution.refusal) << said;
            }
            EXPECT_TRUE(plan.views.empty() && plan.map_count == 0) << said;
            ++tried;
        }
    }
    EXPECT_GE(tried, 100U);
}

/// At the ends of every row's range, by every technique: planned in numbers that can be drawn, or refused.
TEST(HostileOptions, EveryRowAtTheEndsOfItsRangeIsSound)
{
    std::size_t planned = 0;
    for (const ChoiceValue& choice : choiceValues()) {
        if (choice.choice == "light") {
            continue;
        }
        for (const OptionRow& row : optionTable()) {
            if (!hasRange(row)) {
                continue;
            }
            for (const double value : {row.min, row.max}) {
                ShadowOptions options{.technique = kPlainTechnique};
                options.map_size = 64;
                OptionValue name;
                name.text = choice.name;
                findOption(choice.choice)->set(options, name);
                row.set(options, valueOf(value));
                SCOPED_TRACE(std::string(choice.name) + " " + saidOf(row, value));
                Meadow meadow;
                Planner planner(options);
                for (int frame = 0; frame < 2; ++frame) {
                    meadow.lights[0].direction_ws = glm::normalize(glm::dvec3(0.4 + 0.01 * frame, -1, 0.2));
                    meadow.frame.time_s = frame;
                    const Plan& plan = meadow.plan(planner);
                    expectSound(plan, 2);
                    planned += plan.views.size();
                }
            }
        }
    }
    EXPECT_GE(planned, 1000U);
}

TEST(HostileOptions, ValuesThatNoChoiceHasAreRefused)
{
    const auto refused = [](const ShadowOptions& options) {
        Meadow meadow;
        Planner planner(options);
        const Plan& plan = meadow.plan(planner);
        expectSound(plan, 2);
        return plan.lights[0].outcome.kind == OutcomeKind::refused && plan.views.empty();
    };
    EXPECT_TRUE(refused({.technique = {.partition = Partition{77}}}));
    EXPECT_TRUE(refused({.technique = {.fit = Fit{77}}}));
    EXPECT_TRUE(refused({.technique = {.filter = Filter{77}}}));
    EXPECT_TRUE(refused({.technique = {.soften = Soften{77}}}));
    EXPECT_TRUE(refused({.technique = {.motion = Motion{77}}}));
    EXPECT_TRUE(refused({.format = MapFormat{77}}));
    EXPECT_TRUE(refused({.cascades = {.pass = CascadePass{77}}}));
    EXPECT_TRUE(refused({.steps = {.by = StepBy{77}}}));
    EXPECT_TRUE(refused({.keep_still = KeepStill{77}}));
    EXPECT_TRUE(refused({.pcf = {.kernel = PcfKernel{77}}}));
    EXPECT_TRUE(refused({.screen_blur = {.kernel = ScreenKernel{77}}}));
    EXPECT_TRUE(refused({.screen_blur = {.size = ScreenSize{77}}}));
    EXPECT_TRUE(refused({.mask_size = MaskSize{77}}));
    EXPECT_TRUE(refused({.faces = CasterFaces{77}}));
    EXPECT_TRUE(refused({.cull = CasterCull{77}}));
    EXPECT_TRUE(refused({.steps = {.wait = StepWait{77}}}));
    EXPECT_TRUE(refused({.translucent = Translucent{77}}));
    EXPECT_TRUE(refused({.moments = {.metric = DepthMetricKind{77}}}));
    EXPECT_TRUE(refused({.moments = {.samples = 3}}));
    EXPECT_TRUE(refused({.moments = {.placement = LayerPlacement{77}}}));
    EXPECT_TRUE(refused({.max_layers = 0}));
    EXPECT_TRUE(refused({.max_layers = 0xFFFFFFFFU}));
    EXPECT_FALSE(refused({}));
}

TEST(HostileOptions, QuestionsAboutWhatIsRefusedHaveAnswers)
{
    for (const float sigma :
         {std::numeric_limits<float>::quiet_NaN(), -1.0F, 0.0F, 1e38F, std::numeric_limits<float>::infinity()}) {
        ShadowOptions options{.technique = {Partition::single, Fit::uniform, Filter::vsm}};
        options.moments.blur_sigma_texels = sigma;
        EXPECT_GE(blurRadius(options.moments), 1U);
        EXPECT_LE(blurRadius(options.moments), kMaxBlurRadius);
        EXPECT_GT(reachTexels(options), 0.0F);
    }
}

} // namespace
} // namespace gnomon::test
