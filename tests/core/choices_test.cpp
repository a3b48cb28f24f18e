// SPDX-License-Identifier: Apache-2.0
#include <gnomon/choice_rules.h>
#include <gnomon/choices.h>

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace gnomon {
namespace {

TEST(Choices, NamesAreUniqueAndRowsComplete)
{
    std::set<std::string_view> names;
    std::map<std::string_view, unsigned> next_value;
    for (const ChoiceValue& row : choiceValues()) {
        // Each choice that can be left to the planner calls that auto, and smoothies are of the mesh or of the map.
        EXPECT_TRUE(names.insert(row.name).second || row.name == "auto" || row.name == "smoothies")
            << row.name << " twice";
        EXPECT_FALSE(row.summary.empty()) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
        EXPECT_EQ(row.value, next_value[row.choice]++) << row.name << " is not in the order of its enum";
    }
    EXPECT_EQ(next_value,
              (std::map<std::string_view, unsigned>{
                  {"light", 3}, {"partition", 8}, {"fit", 7}, {"filter", 14}, {"soften", 4}, {"motion", 6}}));
}

TEST(Choices, NamesRoundTrip)
{
    for (const ChoiceValue& row : choiceValues()) {
        EXPECT_EQ(findChoice(row.choice, row.name), &row);
        std::string_view name;
        if (row.choice == "light")
            name = nameOf(static_cast<LightType>(row.value));
        else if (row.choice == "partition")
            name = nameOf(static_cast<Partition>(row.value));
        else if (row.choice == "fit")
            name = nameOf(static_cast<Fit>(row.value));
        else if (row.choice == "filter")
            name = nameOf(static_cast<Filter>(row.value));
        else if (row.choice == "soften")
            name = nameOf(static_cast<Soften>(row.value));
        else if (row.choice == "motion")
            name = nameOf(static_cast<Motion>(row.value));
        EXPECT_EQ(name, row.name);
    }
    EXPECT_EQ(findChoice("filter", "none"), nullptr);
    EXPECT_EQ(findChoice("fit", "lispsm-simple")->value, static_cast<std::uint8_t>(Fit::lispsm_simple));
}

TEST(Choices, KernelsAndFormatsRoundTrip)
{
    for (int i = 0; i <= static_cast<int>(PcfKernel::projected_3x3); ++i)
        EXPECT_EQ(findPcfKernel(nameOf(static_cast<PcfKernel>(i))), static_cast<PcfKernel>(i));
    for (int i = 0; i <= static_cast<int>(MapFormat::rg8); ++i)
        EXPECT_EQ(findMapFormat(nameOf(static_cast<MapFormat>(i))), static_cast<MapFormat>(i));
    EXPECT_EQ(findPcfKernel("4x4"), std::nullopt);
    EXPECT_EQ(findMapFormat(""), std::nullopt);
}

TEST(Choices, EveryValueGoesWithSomeLightAndTheOthersDefaults)
{
    for (const ChoiceValue& row : choiceValues()) {
        LightType light = LightType::directional;
        Technique technique;
        if (row.choice == "light")
            light = static_cast<LightType>(row.value);
        else if (row.choice == "partition") {
            technique.partition = static_cast<Partition>(row.value);
            const bool around = technique.partition == Partition::cube || technique.partition == Partition::paraboloid;
            light = around ? LightType::point : light;
        } else if (row.choice == "fit")
            technique.fit = static_cast<Fit>(row.value);
        else if (row.choice == "filter")
            technique.filter = static_cast<Filter>(row.value);
        else if (row.choice == "soften")
            technique.soften = static_cast<Soften>(row.value);
        else
            technique.motion = static_cast<Motion>(row.value);
        EXPECT_EQ(refusal(light, technique), std::nullopt) << row.name;
    }
}

TEST(Choices, APointLightGoesWithWhatGoesAroundAndCubeWithNoSun)
{
    EXPECT_EQ(choiceRules()[0].refuses(),
              "light point with every partition but cube, paraboloid, multi, auto and virtual, filter volumes apart");
    EXPECT_EQ(choiceRules()[1].refuses(), "partition cube with light directional");
    for (const ChoiceValue& partition : choiceValues()) {
        if (partition.choice != "partition")
            continue;
        const Technique technique{.partition = static_cast<Partition>(partition.value)};
        const bool around = partition.name == "cube" || partition.name == "paraboloid" || partition.name == "multi" ||
                            partition.name == "auto" || partition.name == "virtual";
        EXPECT_EQ(refusal(LightType::point, technique), around ? std::nullopt : std::optional(choiceRules()[0].reason));
        for (const LightType other : {LightType::directional, LightType::spot})
            EXPECT_EQ(refusal(other, technique), partition.name == "cube" && other == LightType::directional
                                                     ? std::optional(choiceRules()[1].reason)
                                                 : partition.name == "paraboloid"
                                                     ? std::optional(choiceRules()[8].reason)
                                                     : std::nullopt);
    }
}

TEST(Choices, AParaboloidIsABaselineAndSaysWhatItGoesWith)
{
    using enum Partition;
    const auto said = [](const Technique& technique) {
        return std::string(refusal(LightType::point, technique).value_or(""));
    };
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::automatic})
        for (const Fit fit : {Fit::uniform, Fit::automatic})
            EXPECT_EQ(said({paraboloid, fit, filter}), "");
    for (const Filter filter :
         {Filter::pcss, Filter::raymarch, Filter::vsm, Filter::lvsm, Filter::esm, Filter::evsm, Filter::msm})
        EXPECT_NE(said({paraboloid, Fit::uniform, filter}).find("needs filter hard, pcf or auto"), std::string::npos);
    for (const Fit fit : {Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm})
        EXPECT_NE(said({paraboloid, fit, Filter::pcf}).find("needs fit uniform"), std::string::npos);
    for (const Motion motion :
         {Motion::snap, Motion::step_jump, Motion::step_band, Motion::step_blend, Motion::step_alternate})
        EXPECT_NE(said({paraboloid, Fit::uniform, Filter::pcf, Soften::none, motion}).find("needs motion free"),
                  std::string::npos);
    EXPECT_NE(said({paraboloid, Fit::uniform, Filter::pcf, Soften::converge}).find("needs soften none"),
              std::string::npos);
    const Technique averages{paraboloid, Fit::uniform, Filter::vsm};
    EXPECT_EQ(refusal(averages), refusal(LightType::point, averages));
}

// No light can have it, so the message for a point light does not speak of suns.
TEST(Choices, WhatNoLightCanHaveIsNotBlamedOnTheLight)
{
    const Technique technique{.partition = Partition::cube, .soften = Soften::converge, .motion = Motion::snap};
    ASSERT_TRUE(refusal(technique).has_value());
    EXPECT_NE(refusal(technique)->find("converge moves"), std::string_view::npos) << *refusal(technique);
    EXPECT_FALSE(refusal(Technique{.partition = Partition::cube}).has_value());
}

TEST(Choices, EveryFilterHasTraits)
{
    for (const ChoiceValue& row : choiceValues())
        if (row.choice == "filter") {
            const auto filter = static_cast<Filter>(row.value);
            const FilterTraits* traits = filterTraits(filter);
            ASSERT_EQ(traits != nullptr, filter != Filter::automatic) << row.name;
            if (traits == nullptr) {
                EXPECT_TRUE(refusal(filter, MapFormat::r32f).has_value());
                continue;
            }
            ASSERT_FALSE(traits->formats.empty());
            for (const MapFormat format : traits->formats)
                EXPECT_EQ(refusal(filter, format), std::nullopt);
        }
}

TEST(Choices, AFormatIsRefusedUnlessItsFilterListsIt)
{
    const std::map<Filter, std::set<MapFormat>> usable{
        {Filter::hard,
         {MapFormat::d32f, MapFormat::r32f, MapFormat::d16, MapFormat::rg16, MapFormat::rg16f, MapFormat::rgba8,
          MapFormat::d24}},
        {Filter::pcf,
         {MapFormat::d32f, MapFormat::r32f, MapFormat::d16, MapFormat::rg16, MapFormat::rg16f, MapFormat::rgba8,
          MapFormat::d24}},
        {Filter::vsm, {MapFormat::rg32f, MapFormat::rg16, MapFormat::rg16f}},
        {Filter::lvsm, {MapFormat::rgba16, MapFormat::rgba16f, MapFormat::rgba32f}},
        {Filter::esm, {MapFormat::r32f, MapFormat::r16f}},
        {Filter::evsm, {MapFormat::rgba32f, MapFormat::rgba16f, MapFormat::rg32f, MapFormat::rg16f}},
        {Filter::msm, {MapFormat::rgba16, MapFormat::rgba32f}},
        {Filter::id, {MapFormat::r16, MapFormat::r8}},
        {Filter::depth_id, {MapFormat::rg16, MapFormat::rg8, MapFormat::rg32f}},
    };
    for (const auto& [filter, formats] : usable)
        for (int i = 0; i <= static_cast<int>(MapFormat::rg8); ++i) {
            const auto format = static_cast<MapFormat>(i);
            const auto reason = refusal(filter, format);
            EXPECT_EQ(reason.has_value(), !formats.contains(format)) << nameOf(filter) << " " << nameOf(format);
            for (const MapFormat other : formats) // the sentence says what can be had
                if (reason) {
                    EXPECT_NE(reason->find(nameOf(other)), std::string_view::npos) << *reason;
                }
        }
}

} // namespace
} // namespace gnomon
