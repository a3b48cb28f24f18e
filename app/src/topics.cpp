// SPDX-License-Identifier: Apache-2.0
#include "topics.h"

#include "app/command_line.h"
#include "list_rules.h"
#include "setting_values.h"
#include "wrap_text.h"

#include <gnomon/option_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace gnomon::app {
namespace {

std::string techniquePage(std::string_view name)
{
    return fmt::format("docs/techniques/{}.md", name);
}

bool isIn(std::string_view names, std::string_view name)
{
    const std::vector<std::string_view> all = split(names, ' ');
    return std::ranges::find(all, name) != all.end();
}

std::string pageOf(const ChoiceValue& value)
{
    if (value.choice == "light") {
        return "docs/scenes.md";
    }
    if (isIn("single uniform none free", value.name)) {
        return "docs/architecture.md";
    }
    return techniquePage(value.name.starts_with("step-") ? "sun-steps" : value.name);
}

/// Pages of technique settings that are not named as a value is: by their keys, or by what stands before the dot.
constexpr std::pair<std::string_view, std::string_view> kPages[] = {
    {"auto", "quality"},
    {"sun-steps", "step"},
    {"bias", "bias caster-faces caster-cull"},
    {"translucent", "translucent"},
    {"half-mask", "mask-size"},
    {"atlas", "draw-budget max-layers"},
    {"blur", "soften"},
    {"filterable", "msaa blur map-sampling anisotropy level-depth depth-metric depth-remap min-variance "
                   "derivative-variance penumbra bleeding log-space map-format"},
};

std::string pageOf(const Setting& setting)
{
    const std::string_view topic = setting.key.substr(0, setting.key.find('.'));
    if (setting.group != SettingGroup::technique) {
        return topic == "path" ? "docs/paths.md" : "docs/cli.md";
    }
    if (isChoice(setting.key)) {
        return "docs/architecture.md";
    }
    for (const auto& [page, keys] : kPages) {
        if (isIn(keys, topic)) {
            return techniquePage(page);
        }
    }
    const auto value = std::ranges::find(choiceValues(), topic, &ChoiceValue::name);
    return value != choiceValues().end() ? pageOf(*value) : "docs/cli.md";
}

/// Values that a setting may be tried at: all of a choice, both ends of a range. Lists have none.
std::vector<OptionValue> trialsOf(const OptionRow& row)
{
    std::vector<OptionValue> trials;
    if (row.type == OptionType::choice) {
        for (const std::string_view name : row.choices()) {
            trials.emplace_back().text = name;
        }
    } else if (row.type != OptionType::numbers) {
        for (const double end : {row.min, row.max}) {
            OptionValue& trial = trials.emplace_back();
            trial.flag = trials.size() == 1;
            trial.integer = row.type == OptionType::integer ? static_cast<std::int64_t>(end) : 0;
            trial.real = end;
        }
    }
    return trials;
}

/// Keys of the settings that mean something with the value, at once or after one other setting has changed.
std::set<std::string_view> usedWith(const ChoiceValue& value)
{
    std::set<std::string_view> keys;
    const auto addUsed = [&keys](const ShadowOptions& options) {
        for (const OptionRow& row : optionTable()) {
            if (row.used == nullptr || row.used(options)) {
                keys.insert(row.key);
            }
        }
    };
    ShadowOptions options;
    OptionValue chosen;
    chosen.text = value.name;
    findOption(value.choice)->set(options, chosen);
    addUsed(options);
    for (const OptionRow& row : optionTable()) {
        if (isChoice(row.key)) { // with another choice it would be the other's
            continue;
        }
        for (const OptionValue& trial : trialsOf(row)) {
            ShadowOptions changed = options;
            row.set(changed, trial);
            addUsed(changed);
        }
    }
    return keys;
}

std::vector<Fact> factsOf(const ChoiceValue& value)
{
    std::string write =
        fmt::format("--{0} {1}; {2} in a technique: --technique {2}", value.choice, value.name,
                    // alone it is the filter
                    value.choice == "soften" && value.name == "smoothies" ? "soften=smoothies" : value.name);
    if (value.choice == "light") {
        write = "the scene has its lights; --sun, --spot and --point replace them";
    } else if (value.name == "auto") {
        write = fmt::format("--{} auto, as without it; {}=auto in a technique", value.choice, value.choice);
    }
    const std::vector<std::string_view> formats = formatsOf(value);
    const std::string stored =
        formats.empty() ? std::string()
                        : fmt::format("{} unless --map-format says{}{}", formats.front(), formats.size() > 1 ? " " : "",
                                      joined(std::span(formats).subspan(1), ", "));
    return {{"write", write}, {"stored as", stored}, {"source", std::string(value.source)}, {"page", pageOf(value)}};
}

std::vector<Fact> factsOf(const Setting& setting)
{
    const bool is_flag = setting.type == SettingType::flag;
    const bool has_range = setting.min < setting.max;
    const std::string option =
        is_flag ? fmt::format("--{}", setting.key) : fmt::format("--{} {}", setting.key, setting.form);
    const std::string set = fmt::format("--set {}={}", setting.key, setting.form.empty() ? "0|1" : setting.form);
    const bool has_set = (setting.subcommands & kFrames) != 0 && !setting.command_line_only;
    return {{"write", !has_set             ? option
                      : setting.own_option ? fmt::format("{}, or {}", option, set)
                                           : set},
            {"values", setting.choices != nullptr ? joined(setting.choices()) : std::string()},
            {"default", std::string(setting.default_text)},
            {has_range ? "range" : "unit", has_range ? rangeText(setting) : std::string(setting.unit)},
            {"no value", setting.none_text != setting.default_text ? std::string(setting.none_text) : std::string()},
            {"counts with", std::string(setting.used_when)},
            {"for", joined(subcommandsOf(setting), ", ")},
            {"page", pageOf(setting)}};
}

template <class Named>
std::string namesText(const std::vector<Named>& all)
{
    constexpr std::size_t kMost = 12; // the ring has 89 lamps
    std::string text;
    for (std::size_t i = 0; i < all.size() && i < kMost; ++i) {
        text += fmt::format("{}{}", i == 0 ? "" : ", ", all[i].name);
    }
    return all.size() > kMost ? fmt::format("{} and {} more", text, all.size() - kMost) : text;
}

std::vector<Topic> makeTopics()
{
    std::vector<Topic> table{{"", "choices", "the six choices with their values"},
                             {"", "rules", "what does not go together, and why"},
                             {"", "settings", "every setting with unit, default and range"},
                             {"", "presets", "settings of published techniques, and plain ones"},
                             {"", "worlds", "built-in worlds"}};
    for (const ChoiceValue& row : choiceValues()) {
        if (table.back().choice != row.choice) {
            table.push_back({"choices", row.choice, "a choice", row.choice});
        }
        table.push_back({"choices", row.name, row.summary, row.choice, &row});
    }
    for (const Setting& setting : settingTable()) {
        table.push_back({.section = "settings", .name = setting.key, .summary = setting.doc, .setting = &setting});
    }
    for (const Preset& preset : presets()) {
        table.push_back({.section = "presets", .name = preset.name, .summary = preset.summary, .preset = &preset});
    }
    for (const worlds::World& world : worlds::all()) {
        table.push_back({.section = "worlds", .name = world.name, .summary = world.summary, .world = &world});
    }
    return table;
}

} // namespace

std::span<const Topic> topics()
{
    static const std::vector<Topic> table = makeTopics();
    return table;
}

bool isListed(std::string_view name)
{
    return std::ranges::find(topics(), name, &Topic::name) != topics().end();
}

std::vector<Fact> factsOf(const Topic& topic)
{
    if (topic.value != nullptr) {
        return factsOf(*topic.value);
    }
    if (topic.setting != nullptr) {
        return factsOf(*topic.setting);
    }
    if (topic.preset != nullptr) {
        return {{"write", fmt::format("--preset {}", topic.name)}, {"page", pageOf(topic)}};
    }
    const scene::Scene scene = topic.world->make(1);
    return {{"write", fmt::format("gnomon render {}", topic.name)},
            {"--camera", namesText(scene.views)},
            {"--light", namesText(scene.lights)},
            {"page", pageOf(topic)}};
}

std::string pageOf(const Topic& topic)
{
    if (topic.preset != nullptr) { // those that stand for a document have a page of their own
        return isIn("shastry-2005 rts-2011 icefall-2010 esm-2008 startopia-2006", topic.name)
                   ? techniquePage(topic.name)
                   : "docs/cli.md";
    }
    return topic.value != nullptr     ? pageOf(*topic.value)
           : topic.setting != nullptr ? pageOf(*topic.setting)
                                      : "docs/scenes.md";
}

std::vector<const Setting*> settingsOf(const ChoiceValue& value)
{
    std::vector<const Setting*> settings;
    if (value.choice == "light") { // lights are the scene's, so no setting of the library knows them
        for (const Setting& setting : settingTable()) {
            if (isIn(setting.of_lights, value.name)) {
                settings.push_back(&setting);
            }
        }
        return settings;
    }
    std::vector<std::set<std::string_view>> others;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == value.choice && row.name != "auto") { // which may come to any
            others.push_back(usedWith(row));
        }
    }
    const std::set<std::string_view> used = usedWith(value);
    for (const Setting& setting : settingTable()) {
        const auto count = std::ranges::count_if(
            others, [&setting](const std::set<std::string_view>& keys) { return keys.contains(setting.key); });
        const bool is_own = used.contains(setting.key) && 3 * static_cast<std::size_t>(count) <= 2 * others.size();
        // Some settings of a value also need a value of another choice, and are known by their name. Where a setting
        // has the value's name, such names belong to that setting.
        const bool is_named_for =
            findSetting(value.name) == nullptr && setting.key.starts_with(fmt::format("{}.", value.name));
        if (is_own || is_named_for) {
            settings.push_back(&setting);
        }
    }
    return settings;
}

} // namespace gnomon::app
