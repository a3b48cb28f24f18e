// SPDX-License-Identifier: Apache-2.0
#include <gnomon/error.h>
#include <gnomon/option_table.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace gnomon {
namespace {

OptionValue numberOf(double number)
{
    OptionValue value;
    value.real = number;
    value.integer = std::abs(number) < 1e18 ? static_cast<std::int64_t>(number) : 0;
    value.numbers = {number};
    return value;
}

bool isNumber(const OptionRow& row)
{
    return row.type == OptionType::integer || row.type == OptionType::real;
}

TEST(Options, DefaultsResolve)
{
    const Resolution resolution = resolve({});
    ASSERT_TRUE(resolution) << resolution.refusal;
    EXPECT_EQ(resolution->format(), MapFormat::d32f);
    EXPECT_EQ(resolution->border_texels(), 4.0);
    EXPECT_FALSE(resolution->paired_maps());
}

TEST(Options, WhatIsCutOffAtOneIsNotAveragedAfterwards)
{
    for (const Soften soften : {Soften::none, Soften::smoothies, Soften::blur, Soften::converge}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.soften = soften;
        options.lighten = 0.5F;
        EXPECT_TRUE(resolve(options)) << nameOf(soften);
        options.lighten_as = LightenAs::add;
        const bool averages = soften == Soften::blur || soften == Soften::converge;
        EXPECT_EQ(!resolve(options), averages) << nameOf(soften);
        options.lighten = 0.0F;
        EXPECT_TRUE(resolve(options)) << nameOf(soften);
    }
}

/// A host that says which filter it wants need not know what that stores.
TEST(Options, AFilterAloneIsEnough)
{
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice != "filter")
            continue;
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = static_cast<Filter>(row.value);
        const Resolution resolution = resolve(options);
        ASSERT_TRUE(resolution) << row.name << ": " << resolution.refusal;
        EXPECT_EQ(resolution->format(), resolution->traits().formats.front()) << row.name;
        EXPECT_GE(resolution->border_texels(), double{resolution->reach_texels()}) << row.name;
    }
}

TEST(Options, WhatCannotBePlannedIsRefused)
{
    EXPECT_EQ(resolve({.map_size = 0}).refusal, "map-size is 0; it can be 16 to 16384 texels");
    EXPECT_EQ(resolve({.border_texels = std::numeric_limits<double>::quiet_NaN()}).refusal.substr(0, 6), "border");
    EXPECT_EQ(resolve({.max_layers = 0}).refusal, "max_layers is 0; it can be 1 to 2048");
    EXPECT_FALSE(resolve({.technique = {.filter = Filter::vsm, .soften = Soften::smoothies}}));
    EXPECT_FALSE(
        resolve({.technique = {.filter = Filter::pcf, .soften = Soften::smoothies}, .format = MapFormat::rg16}));
    EXPECT_TRUE(resolve({.technique = {.soften = Soften::smoothies}}));
    EXPECT_FALSE(resolve({.technique = {.filter = Filter::msm}, .format = MapFormat::d32f}));
    ShadowOptions ends{.technique = kPlainTechnique};
    ends.cascades.ends_m = {20.0, 10.0};
    EXPECT_FALSE(resolve(ends));
    EXPECT_THROW(static_cast<void>(resolvedOrThrow({.map_size = 0})), Error);
}

/// Edges of meshes go with less than those of maps do: no other filter, and nothing twice.
TEST(Options, FinsAreAFilterThatReadsAsPcfDoes)
{
    ShadowOptions fins{.technique = kPlainTechnique};
    fins.technique.filter = Filter::smoothies;
    const ResolvedOptions made = resolvedOrThrow(fins);
    EXPECT_TRUE(made.hasFins() && made.hasSmoothies() && made.integratesLight() && made.hasMaps());
    EXPECT_FALSE(made.filterable() || made.traits().integrates_light);
    ShadowOptions pcf{.technique = kPlainTechnique};
    EXPECT_EQ(made.reach_texels(), resolvedOrThrow(pcf).reach_texels());
    pcf.technique.soften = Soften::smoothies;
    EXPECT_TRUE(resolvedOrThrow(pcf).hasSmoothies());
    EXPECT_FALSE(resolvedOrThrow(pcf).hasFins());
    const auto refusalWith = [&](const auto& change) {
        ShadowOptions wrong = fins;
        change(wrong);
        return resolve(wrong).refusal;
    };
    EXPECT_NE(refusalWith([](ShadowOptions& o) { o.technique.soften = Soften::smoothies; }).find("softness of"),
              std::string::npos);
    EXPECT_NE(refusalWith([](ShadowOptions& o) { o.technique.partition = Partition::paraboloid; }).find("bends"),
              std::string::npos);
    EXPECT_NE(refusalWith([](ShadowOptions& o) { o.format = MapFormat::rg16; }).find("its texels for itself"),
              std::string::npos);
    EXPECT_NE(refusalWith([](ShadowOptions& o) { o.moments.metric = DepthMetricKind::z_over_w; }).find("z / w"),
              std::string::npos);
    for (const Soften soften : {Soften::blur, Soften::converge}) {
        EXPECT_EQ(refusalWith([&](ShadowOptions& o) { o.technique.soften = soften; }), "");
    }
}

TEST(Options, HalfAMaskIsRefusedWhereFramesConverge)
{
    ShadowOptions half{.technique = kPlainTechnique, .mask_size = MaskSize::half};
    for (const Soften soften : {Soften::none, Soften::smoothies, Soften::blur}) {
        half.technique.soften = soften;
        EXPECT_TRUE(resolve(half)) << nameOf(soften);
        EXPECT_TRUE(resolve(half)->halvesMask());
    }
    half.technique.soften = Soften::converge;
    EXPECT_NE(resolve(half).refusal.find("mask-size"), std::string::npos);
    half.mask_size = MaskSize::full;
    ASSERT_TRUE(resolve(half));
    EXPECT_FALSE(resolve(half)->halvesMask());
}

TEST(Options, WhatWasPublishedOfTheBlurIsRefusedWhereItMeansNothing)
{
    ShadowOptions blur{.technique = kPlainTechnique};
    blur.technique.soften = Soften::blur;
    EXPECT_TRUE(resolve(blur));
    blur.screen_blur.taps = ScreenTaps::published;
    EXPECT_NE(resolve(blur).refusal.find("knows no edges"), std::string::npos);
    blur.screen_blur.edges = ScreenEdges::plain;
    EXPECT_TRUE(resolve(blur));
    blur.screen_blur.kernel = ScreenKernel::box;
    EXPECT_NE(resolve(blur).refusal.find("Gaussian's"), std::string::npos);
    blur.technique.soften = Soften::none;
    EXPECT_TRUE(resolve(blur)) << "nobody asks for it then";
    blur.screen_blur.strength_px = 8.5F;
    EXPECT_FALSE(resolve(blur));
}

TEST(Options, NinePointsReachATexelAndAHalf)
{
    for (const PcfKernel kernel : {PcfKernel::box_3x3, PcfKernel::projected_3x3}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.pcf.kernel = kernel;
        EXPECT_EQ(resolvedOrThrow(options).reach_texels(), 1.5F);
        EXPECT_LT(kernelWidth(kernel), 0);
    }
}

/// Plans are copied for reports, and outlive their planner.
TEST(Options, ARefusalOutlivesThePlanner)
{
    ObjectSet objects;
    objects.add({{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}});
    const Light sun;
    Frame frame;
    frame.lights = {&sun, 1};
    frame.objects = &objects;
    Plan kept;
    {
        Planner planner(ShadowOptions{.map_size = 0});
        kept = planner.plan(frame);
    }
    EXPECT_EQ(kept.lights.at(0).outcome.kind, OutcomeKind::refused);
    EXPECT_EQ(kept.lights[0].outcome.reason, "map-size is 0; it can be 16 to 16384 texels");
}

TEST(OptionTable, KeysAreUniqueAndSayWhenTheyCount)
{
    std::set<std::string_view> keys;
    for (const OptionRow& row : optionTable()) {
        EXPECT_TRUE(keys.insert(row.key).second) << row.key;
        EXPECT_EQ(row.used == nullptr, row.used_when.empty()) << row.key;
        EXPECT_EQ(findOption(row.key), &row);
        EXPECT_EQ(row.type == OptionType::choice, row.choices != nullptr) << row.key;
    }
    EXPECT_EQ(findOption("no such"), nullptr);
}

/// A value that is read and written back is the same, and every choice has a name.
TEST(OptionTable, ReadsWhatItWrites)
{
    for (const OptionRow& row : optionTable()) {
        ShadowOptions options{.technique = kPlainTechnique};
        const OptionValue usual = row.get(options);
        if (!usual.none && row.type != OptionType::numbers) {
            row.set(options, usual);
            EXPECT_EQ(textOf(row, row.get(options)), textOf(row, usual)) << row.key;
        }
        if (row.type == OptionType::choice) {
            for (const std::string_view name : row.choices()) {
                OptionValue value;
                value.text = name;
                row.set(options, value);
                EXPECT_EQ(textOf(row, row.get(options)), name) << row.key;
            }
        }
    }
}

TEST(OptionTable, TextsAreReadAsTheyAreWritten)
{
    for (const OptionRow& row : optionTable()) {
        ShadowOptions options;
        for (const double number : {row.min, row.max}) {
            OptionValue value = row.get(options);
            value.none = false;
            value.integer = static_cast<std::int64_t>(number);
            value.real = number;
            value.flag = number > 0.0;
            value.numbers.assign(row.type == OptionType::numbers ? row.count : 0, number);
            if (row.type == OptionType::choice) {
                value.text = number == row.min ? row.choices().front() : row.choices().back();
            }
            const OptionReading reading = readOption(row, textOf(row, value));
            ASSERT_TRUE(reading.value) << row.key << ": " << reading.expected;
            EXPECT_EQ(textOf(row, *reading.value), textOf(row, value)) << row.key;
            EXPECT_EQ(reading.value->numbers, value.numbers) << row.key;
        }
        EXPECT_EQ(readOption(row, row.none_text).value.has_value(), !row.none_text.empty()) << row.key;
        for (const std::string_view wrong : {"", " ", "nan", "inf", "1e400", "0x10", "1 ", "1,5", "1/", "/", "-1e19"}) {
            const OptionReading reading = readOption(row, wrong);
            EXPECT_FALSE(reading.value) << row.key << " takes \"" << wrong << "\"";
            EXPECT_NE(reading.expected, "") << row.key;
        }
    }
}

TEST(OptionTable, SaysWhatItTakesInstead)
{
    const auto expected = [](std::string_view key, std::string_view text) {
        return readOption(*findOption(key), text).expected;
    };
    EXPECT_EQ(expected("pcf.taps", "65"), "in the range 4 to 64 taps");
    EXPECT_EQ(expected("pcf.taps", "x"), "a whole number in the range 4 to 64 taps");
    EXPECT_EQ(expected("map-size", "x"), "auto or a whole number in the range 16 to 16384 texels");
    EXPECT_EQ(expected("bias.constant", "x"), "a finite number in the range -1000000 to 1000000 m");
    EXPECT_EQ(expected("level-depth", "2"), "0 or 1");
    EXPECT_EQ(expected("lighten.as", "x"), "remap or add");
}

TEST(OptionTable, NumbersEndWhereTheirRangesDo)
{
    for (const OptionRow& row : optionTable()) {
        if (!isNumber(row))
            continue;
        const double step = row.type == OptionType::integer ? 1.0 : 0.01 * (row.max - row.min);
        for (const double inside : {row.min, row.max}) {
            ShadowOptions options{.technique = kPlainTechnique};
            row.set(options, numberOf(inside));
            EXPECT_EQ(firstOutOfRange(options), std::nullopt) << row.key << " " << inside;
        }
        ShadowOptions options{.technique = kPlainTechnique};
        row.set(options, numberOf(row.max + step));
        EXPECT_EQ(firstOutOfRange(options).value_or("").substr(0, row.key.size()), row.key);
        if (row.type == OptionType::real) {
            row.set(options, numberOf(std::numeric_limits<double>::quiet_NaN()));
            EXPECT_NE(firstOutOfRange(options), std::nullopt) << row.key;
        }
    }
}

/// Where two settings say one thing, the last one holds.
TEST(OptionTable, EndsAndCountOfCascadesAgree)
{
    const OptionRow& count = *findOption("cascades.count");
    const OptionRow& ends = *findOption("cascades.ends");
    ShadowOptions options{.technique = kPlainTechnique};
    OptionValue two;
    two.numbers = {10.0, 40.0};
    ends.set(options, two);
    EXPECT_EQ(options.cascades.count, 3U);
    EXPECT_EQ(textOf(ends, ends.get(options)), "10/40");
    count.set(options, numberOf(5.0));
    EXPECT_FALSE(options.cascades.explicitEnds());
    EXPECT_TRUE(ends.get(options).none);
}

} // namespace
} // namespace gnomon
