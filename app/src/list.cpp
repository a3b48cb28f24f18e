// SPDX-License-Identifier: Apache-2.0
// `gnomon list`: every value of every choice, every refusal, every setting, preset and world.
#include "app/preset.h"
#include "result_json.h"
#include "subcommands.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

namespace gnomon::app {
namespace {

constexpr std::string_view kTechniqueGrammar =
    "A technique is values of the choices and KEY=VALUE of technique settings, joined by + in any order; what is left "
    "out has its "
    "default: hard, pcf+pcf.kernel=5x5+map-size=1024. Lists of techniques have commas between.";

/// Refused combinations of values that are available one by one: one line for each reason and light.
struct RefusedCombination {
    std::string light;
    std::string choices;
    std::string reason;
};

std::vector<std::string_view> availableValues(std::string_view choice)
{
    std::vector<std::string_view> names;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == choice && row.available) {
            names.push_back(row.name);
        }
    }
    return names;
}

template <typename Enum>
Enum valueOf(std::string_view choice, std::string_view name)
{
    return static_cast<Enum>(findChoice(choice, name)->value);
}

/// Visits every combination of available values.
template <typename Visit>
void forEachCombination(const Visit& visit)
{
    for (const auto light : availableValues("light")) {
        for (const auto partition : availableValues("partition")) {
            for (const auto fit : availableValues("fit")) {
                for (const auto filter : availableValues("filter")) {
                    for (const auto soften : availableValues("soften")) {
                        for (const auto motion : availableValues("motion")) {
                            visit(valueOf<LightType>("light", light),
                                  Technique{valueOf<Partition>("partition", partition), valueOf<Fit>("fit", fit),
                                            valueOf<Filter>("filter", filter), valueOf<Soften>("soften", soften),
                                            valueOf<Motion>("motion", motion)});
                        }
                    }
                }
            }
        }
    }
}

std::vector<MapFormat> allFormats()
{
    std::vector<MapFormat> formats;
    for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(MapFormat::rgba8); ++i) {
        formats.push_back(static_cast<MapFormat>(i));
    }
    return formats;
}

void addRefusedFormats(std::vector<RefusedCombination>& refused)
{
    for (const auto filter : availableValues("filter")) {
        for (const MapFormat format : allFormats()) {
            if (const auto reason = refusal(valueOf<Filter>("filter", filter), format)) {
                refused.push_back(
                    {"any", fmt::format("{}+map-format={}", filter, nameOf(format)), std::string(*reason)});
            }
        }
    }
}

/// What a filter's options may not be with a format that it can use: each at the end of its range.
void addRefusedMoments(std::vector<RefusedCombination>& refused)
{
    constexpr std::string_view kOptions[] = {"depth-remap=1", "esm.exponent=10000", "evsm.positive=10000",
                                             "evsm.negative=10000"};
    const Settings defaults = defaultSettings();
    for (const auto filter : availableValues("filter")) {
        for (const std::string_view option : kOptions) {
            for (const MapFormat format : filterTraits(valueOf<Filter>("filter", filter))->formats) {
                const std::string text = fmt::format("{}+map-format={}", filter, nameOf(format));
                Settings settings = parseTechnique(defaults, text);
                const std::size_t equals = option.find('=');
                const Setting& setting = *findSetting(option.substr(0, equals));
                applySetting(settings, setting, option.substr(equals + 1));
                if (!isUsed(setting, settings)) {
                    continue;
                }
                if (const auto reason = refusal(settings.shadow.technique.filter, format, settings.shadow.moments)) {
                    refused.push_back({"any", fmt::format("{}+{}", text, option), *reason});
                }
            }
        }
    }
}

/// Rows that differ in their last value alone, for one reason, as one: map-format=d16|d32f.
std::vector<RefusedCombination> joined(const std::vector<RefusedCombination>& rows)
{
    std::vector<RefusedCombination> made;
    for (const RefusedCombination& row : rows) {
        const std::size_t value = row.choices.rfind('=') + 1; // 0: none
        const bool follows = value != 0 && !made.empty() && made.back().light == row.light &&
                             made.back().reason == row.reason &&
                             made.back().choices.starts_with(std::string_view(row.choices).substr(0, value));
        if (follows) {
            made.back().choices += "|" + row.choices.substr(value);
        } else {
            made.push_back(row);
        }
    }
    return made;
}

std::vector<RefusedCombination> refusedCombinations()
{
    std::vector<RefusedCombination> refused;
    forEachCombination([&](LightType light, const Technique& t) {
        if (const auto reason = refusal(light, t)) {
            refused.push_back({std::string(nameOf(light)),
                               fmt::format("{}+{}+{}+{}+{}", nameOf(t.partition), nameOf(t.fit), nameOf(t.filter),
                                           nameOf(t.soften), nameOf(t.motion)),
                               std::string(*reason)});
        }
    });
    addRefusedFormats(refused);
    addRefusedMoments(refused);
    return refused;
}

std::string settingLine(const Setting& setting)
{
    std::string facts;
    const auto add = [&](const std::string& fact) {
        facts += (facts.empty() ? "" : ", ") + fact;
    };
    if (!setting.unit.empty()) {
        add(std::string(setting.unit));
    }
    if (!setting.default_text.empty()) {
        add(fmt::format("default {}", setting.default_text));
    }
    if (setting.min < setting.max) {
        add(fmt::format("{} to {}", setting.min, setting.max));
    }
    if (setting.choices != nullptr) {
        std::string names;
        for (const auto name : setting.choices()) {
            names += (names.empty() ? "" : " ") + std::string(name);
        }
        add("one of " + names);
    }
    if (!setting.used_when.empty()) {
        add(fmt::format("with {}", setting.used_when));
    }
    return fmt::format("  {:<20} {}{}\n", setting.key, setting.doc, facts.empty() ? "" : " [" + facts + "]");
}

std::string textList()
{
    std::string text = "Choices (a value that is not in this version is marked -; sources are in --json):\n";
    std::string_view choice;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice != choice) {
            choice = row.choice;
            text += fmt::format("{}\n", choice);
        }
        text += fmt::format("  {} {:<15} {}\n", row.available ? ' ' : '-', row.name, row.summary);
    }
    text += "\nRefused combinations of values that are in this version:\n";
    for (const RefusedCombination& row : joined(refusedCombinations())) {
        text += fmt::format("  {} light, {}: {}\n", row.light, row.choices, row.reason);
    }
    text += "\nSettings (options of their own as --KEY; all by --set KEY=VALUE and in presets):\n";
    for (const Setting& setting : settingTable()) {
        text += settingLine(setting);
    }
    text += "\nPresets:\n";
    for (const Preset& preset : presets()) {
        text += fmt::format("  {:<20} {}\n", preset.name, preset.summary);
    }
    text += "\nBuilt-in worlds:\n";
    for (const scene::World& world : scene::worlds()) {
        text += fmt::format("  {:<20} {}\n", world.name, world.summary);
    }
    return text + fmt::format("\n{}\n", kTechniqueGrammar);
}

Json choiceList()
{
    Json choices = Json::array();
    for (const ChoiceValue& row : choiceValues()) {
        if (choices.empty() || choices.back()["choice"] != row.choice) {
            choices.push_back({{"choice", row.choice}, {"values", Json::array()}});
        }
        choices.back()["values"].push_back(
            {{"name", row.name}, {"available", row.available}, {"summary", row.summary}, {"source", row.source}});
    }
    return choices;
}

Json jsonList()
{
    Json json{{"version", GNOMON_VERSION}, {"choices", choiceList()}, {"technique_grammar", kTechniqueGrammar}};
    json["refused"] = Json::array();
    for (const RefusedCombination& row : refusedCombinations()) {
        json["refused"].push_back({{"light", row.light}, {"technique", row.choices}, {"reason", row.reason}});
    }
    json["settings"] = Json::array();
    for (const Setting& setting : settingTable()) {
        json["settings"].push_back(settingJson(setting));
    }
    json["presets"] = Json::array();
    for (const Preset& preset : presets()) {
        json["presets"].push_back(
            {{"name", preset.name}, {"summary", preset.summary}, {"settings", Json::parse(preset.json)}});
    }
    json["worlds"] = Json::array();
    for (const scene::World& world : scene::worlds()) {
        json["worlds"].push_back({{"name", world.name}, {"summary", world.summary}});
    }
    return json;
}

} // namespace

int runList(const Settings& settings)
{
    if (settings.json.empty()) {
        writeStdout(textList());
    } else {
        writeResult(settings.json, jsonList().dump(2) + "\n");
    }
    return 0;
}

} // namespace gnomon::app
