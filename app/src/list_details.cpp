// SPDX-License-Identifier: Apache-2.0
#include "list_details.h"

#include "app/command_line.h"
#include "doc_pages.h"
#include "list_rules.h"
#include "wrap_text.h"

#include <gnomon/option_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace gnomon::app {
namespace {

constexpr std::size_t kFacts = 15; // the column of facts
constexpr std::size_t kNames = 20; // the column where settings and presets are explained

std::string fact(std::string_view name, std::string_view text)
{
    return text.empty() ? std::string() : entryText(name, text, kFacts);
}

bool isChoiceKey(std::string_view key)
{
    return std::ranges::any_of(choiceValues(), [key](const ChoiceValue& row) { return row.choice == key; });
}

/// Values that a setting may be tried at: all of a choice, both ends of a range.
std::vector<OptionValue> trialsOf(const OptionRow& row)
{
    std::vector<OptionValue> trials;
    const auto add = [&trials](auto member, auto value) {
        OptionValue trial;
        trial.*member = value;
        trials.push_back(trial);
    };
    switch (row.type) {
    case OptionType::flag:
        add(&OptionValue::flag, true);
        add(&OptionValue::flag, false);
        break;
    case OptionType::integer:
        add(&OptionValue::integer, static_cast<std::int64_t>(row.min));
        add(&OptionValue::integer, static_cast<std::int64_t>(row.max));
        break;
    case OptionType::real:
        add(&OptionValue::real, row.min);
        add(&OptionValue::real, row.max);
        break;
    case OptionType::choice:
        for (const std::string_view name : row.choices()) {
            add(&OptionValue::text, std::string(name));
        }
        break;
    case OptionType::numbers:
        break;
    }
    return trials;
}

void addUsed(const ShadowOptions& options, std::set<std::string_view>& keys)
{
    for (const OptionRow& row : optionTable()) {
        if (row.used == nullptr || row.used(options)) {
            keys.insert(row.key);
        }
    }
}

/// Keys of the settings that mean something with the value, at once or after one other setting has changed.
std::set<std::string_view> usedWith(const ChoiceValue& value)
{
    ShadowOptions options;
    OptionValue chosen;
    chosen.text = value.name;
    findOption(value.choice)->set(options, chosen);
    std::set<std::string_view> keys;
    addUsed(options, keys);
    for (const OptionRow& row : optionTable()) {
        if (isChoiceKey(row.key)) { // with another choice it would be the other's
            continue;
        }
        for (const OptionValue& trial : trialsOf(row)) {
            ShadowOptions changed = options;
            row.set(changed, trial);
            addUsed(changed, keys);
        }
    }
    return keys;
}

/// Lights are the scene's, so no setting of the library knows them.
std::vector<std::string_view> keysOfLight(std::string_view name)
{
    if (name == "directional") {
        return {"sun", "sun-angle"};
    }
    return name == "spot" ? std::vector<std::string_view>{"spot", "spot.cone", "spot.near", "spot.range", "light-size"}
                          : std::vector<std::string_view>{"point", "light-size"};
}

std::string namesOfSubcommands(const Setting& setting)
{
    std::vector<std::string_view> names;
    for (const Subcommand& subcommand : subcommands()) {
        if ((setting.subcommands & subcommand.bit) != 0) {
            names.push_back(subcommand.name);
        }
    }
    return joined(names, ", ");
}

std::string rangeOf(const Setting& setting)
{
    if (!(setting.min < setting.max)) {
        return std::string(setting.unit);
    }
    const std::string range = fmt::format("{} to {}", setting.min, setting.max);
    return setting.unit.empty() ? range : fmt::format("{} {}", range, setting.unit);
}

std::string howToWrite(const Setting& setting)
{
    const bool is_flag = setting.type == SettingType::flag;
    const std::string form = setting.form.empty() ? "0|1" : std::string(setting.form);
    std::string option = is_flag ? fmt::format("--{}", setting.key) : fmt::format("--{} {}", setting.key, setting.form);
    const std::string set = fmt::format("--set {}={}", setting.key, form);
    if ((setting.subcommands & kFrames) == 0 || setting.command_line_only) {
        return option;
    }
    return setting.own_option ? fmt::format("{}, or {}", option, set) : set;
}

std::string howToWrite(const ChoiceValue& value)
{
    if (value.choice == "light") {
        return "the scene has its lights; --sun, --spot and --point replace them";
    }
    if (value.name == "auto") {
        return fmt::format("--{} auto, as without it; {}=auto in a technique", value.choice, value.choice);
    }
    const bool is_shared = value.choice == "soften" && value.name == "smoothies"; // alone it is the filter
    return fmt::format("--{0} {1}; {2} in a technique: --technique {2}", value.choice, value.name,
                       is_shared ? "soften=smoothies" : value.name);
}

std::string formatsOf(const ChoiceValue& value)
{
    const FilterTraits* const traits =
        value.choice == "filter" ? filterTraits(static_cast<Filter>(value.value)) : nullptr;
    if (traits == nullptr || !traits->has_maps) {
        return {};
    }
    std::string text = fmt::format("{} unless --map-format says", nameOf(traits->formats.front()));
    for (const MapFormat format : traits->formats.subspan(1)) {
        text += fmt::format("{} {}", format == traits->formats[1] ? "" : ",", nameOf(format));
    }
    return text;
}

std::string refusedText(const std::vector<Refused>& refused)
{
    std::string text;
    for (const Refused& row : refused) {
        text += wrapped("  ", fmt::format("{}: {}", row.technique, row.reason), 4);
    }
    return text;
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

} // namespace

std::vector<const Setting*> settingsOf(const ChoiceValue& value)
{
    std::vector<const Setting*> settings;
    if (value.choice == "light") {
        for (const std::string_view key : keysOfLight(value.name)) {
            settings.push_back(findSetting(key));
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

std::string choiceText(std::string_view choice)
{
    const Setting* const setting = findOption(choice) != nullptr ? findSetting(choice) : nullptr;
    std::string text = fmt::format("{}, a choice: {}\n", choice,
                                   setting == nullptr ? "what casts; each light of the scene is one of them"
                                                      : std::string(setting->doc));
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == choice) {
            text += entryText(row.name, row.summary, kNames);
        }
    }
    if (setting != nullptr) {
        text += fmt::format("Without a word it is {}. `gnomon list VALUE` has settings, rules and source of each.\n",
                            setting->default_text);
    }
    return text;
}

std::string valueText(const ChoiceValue& value)
{
    std::string text = wrapped(fmt::format("{}, a value of {}: ", value.name, value.choice), value.summary, 2);
    text += fact("write", howToWrite(value));
    text += fact("stored as", formatsOf(value));
    text += fact("source", value.source);
    text += fact("page", pageOf(value));
    if (const std::vector<const Setting*> settings = settingsOf(value); !settings.empty()) {
        text += "Settings of its own, by --set KEY=VALUE, in presets and techniques:\n";
        for (const Setting* setting : settings) {
            text += settingLine(*setting);
        }
    }
    if (const std::vector<Refused> refused = refusedOf(value); !refused.empty()) {
        text += "Refused:\n" + refusedText(refused);
    }
    return text;
}

std::string settingText(const Setting& setting)
{
    std::string text = wrapped(fmt::format("{}, a setting: ", setting.key), setting.doc, 2);
    text += fact("write", howToWrite(setting));
    if (setting.choices != nullptr) {
        text += fact("values", joined(setting.choices()));
    }
    text += fact("default", setting.default_text);
    text += fact(setting.min < setting.max ? "range" : "unit", rangeOf(setting));
    if (!setting.none_text.empty() && setting.none_text != setting.default_text) {
        text += fact("no value", setting.none_text);
    }
    text += fact("counts with", setting.used_when);
    text += fact("for", namesOfSubcommands(setting));
    return text + fact("page", pageOf(setting));
}

std::string presetText(const Preset& preset)
{
    return wrapped(fmt::format("{}, a preset: ", preset.name), preset.summary, 2) +
           fact("write", fmt::format("--preset {}", preset.name)) + fact("page", pageOfPreset(preset.name)) +
           fmt::format("{}\n", preset.json);
}

std::string worldText(const worlds::World& world)
{
    const scene::Scene scene = world.make(1);
    std::vector<std::string_view> cameras;
    return wrapped(fmt::format("{}, a built-in world: ", world.name), world.summary, 2) +
           fact("write", fmt::format("gnomon render {}", world.name)) + fact("--camera", namesText(scene.views)) +
           fact("--light", namesText(scene.lights)) + fact("page", "docs/scenes.md");
}

std::string settingLine(const Setting& setting)
{
    std::string facts;
    const auto add = [&](const std::string& more) {
        facts += (facts.empty() ? "" : ", ") + more;
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
        add("one of " + joined(setting.choices()));
    }
    if (!setting.used_when.empty()) {
        add(fmt::format("with {}", setting.used_when));
    }
    return entryText(setting.key, facts.empty() ? std::string(setting.doc) : fmt::format("{} [{}]", setting.doc, facts),
                     kNames + 2);
}

std::string rulesText()
{
    return "What does not go together, and why:\n" + refusedText(allRefused());
}

} // namespace gnomon::app
