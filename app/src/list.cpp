// SPDX-License-Identifier: Apache-2.0
// `gnomon list`: the choices and what they refuse on a few screens; with a name, all there is to say of it.
#include "list.h"

#include "app/command_line.h"
#include "list_details.h"
#include "list_json.h"
#include "list_rules.h"
#include "result_json.h"
#include "streams.h"
#include "subcommands.h"
#include "worlds/worlds.h"
#include "wrap_text.h"

#include <gnomon/choice_rules.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gnomon::app {
namespace {

constexpr std::array<std::string_view, 6> kChoices{"light", "partition", "fit", "filter", "soften", "motion"};

std::string allChoicesText()
{
    std::string text;
    for (const std::string_view choice : kChoices) {
        const Setting* const setting = choice == "light" ? nullptr : findSetting(choice);
        text += setting == nullptr ? fmt::format("{}: what casts\n", choice)
                                   : fmt::format("{}: {} ({})\n", choice, setting->doc, setting->default_text);
        for (const ChoiceValue& row : choiceValues()) {
            if (row.choice == choice) {
                text += entryText(row.name, row.summary, 18);
            }
        }
    }
    return text;
}

std::string storageText()
{
    std::string text;
    for (const StoredAs& row : storageOfFilters()) {
        std::vector<std::string_view> formats;
        for (const MapFormat format : row.formats) {
            formats.push_back(nameOf(format));
        }
        text += entryText(joined(row.filters, " "), formats.empty() ? "no map, so no format" : joined(formats), 28);
    }
    return text;
}

std::string settingsText()
{
    std::string text =
        "Settings (options of their own as --KEY; all by --set KEY=VALUE, and in presets all except outputs):\n";
    for (const Setting& setting : settingTable()) {
        text += settingLine(setting);
    }
    return text;
}

std::string presetsText()
{
    std::string text = "Presets, for --preset:\n";
    for (const Preset& preset : presets()) {
        text += entryText(preset.name, preset.summary, 18);
    }
    return text;
}

std::string worldsText()
{
    std::string text = "Built-in worlds, in the place of a scene's file:\n";
    for (const worlds::World& world : worlds::all()) {
        text += entryText(world.name, world.summary, 12);
    }
    return text;
}

struct Section {
    std::string_view name;
    std::string_view summary;
    std::string (*text)();
};
constexpr std::array kSections{
    Section{"choices", "the six choices with their values", allChoicesText},
    Section{"rules", "what does not go together, and why", rulesText},
    Section{"settings", "every setting with unit, default and range", settingsText},
    Section{"presets", "settings of published techniques, and plain ones", presetsText},
    Section{"worlds", "built-in worlds", worldsText},
};

std::string namesLine(std::string_view what, const std::vector<std::string_view>& names)
{
    return entryText(what, joined(names), 14);
}

template <class Range>
std::vector<std::string_view> namesIn(const Range& range)
{
    std::vector<std::string_view> names;
    names.reserve(std::size(range));
    for (const auto& one : range) {
        names.push_back(one.name);
    }
    return names;
}

/// A few screens.
std::string overviewText()
{
    std::string text =
        wrapped("", kTechniqueGrammar, 0) + "\n" + allChoicesText() + "\nRefused, before anything is drawn:\n";
    for (const ChoiceRule& rule : choiceRules()) {
        text += wrapped("  ", rule.reason, 4);
    }
    text += "\nMap formats, the usual one first; a filter refuses all others (`gnomon list rules` says why):\n" +
            storageText();
    text += "\n" + wrapped("",
                           "One name in full: `gnomon list msm` has a value's settings, rules and source; so have "
                           "`list pcf.kernel` a setting, and `list rts` a world. All of a kind:",
                           0);
    text += entryText("gnomon list", joined(namesIn(kSections), "|"), 14);
    text += namesLine("presets", namesIn(presets()));
    text += namesLine("worlds", namesIn(worlds::all()));
    text += namesLine("subcommands", namesIn(subcommands()));
    return text + "`gnomon SUBCOMMAND --help` has a subcommand's options; --json has all of this for scripts.\n";
}

const Section* findSection(std::string_view name)
{
    const auto* const found = std::ranges::find(kSections, name, &Section::name);
    return found == kSections.end() ? nullptr : found;
}

[[noreturn]] void refuseTopic(std::string_view name)
{
    for (const Subcommand& subcommand : subcommands()) {
        if (subcommand.name == name) {
            throw UsageError(fmt::format("list: {0} is a subcommand; see `gnomon {0} --help`", name));
        }
    }
    std::vector<std::string_view> names;
    for (const ListedName& listed_name : listedNames()) {
        names.push_back(listed_name.name);
    }
    throw UsageError(fmt::format("list has nothing called \"{}\"{}; `gnomon list` shows what there is", name,
                                 suggestion(name, names)));
}

/// Everything of that name: `blur` is a value and a setting.
std::string topicText(std::string_view name)
{
    std::vector<std::string> texts;
    if (const Section* section = findSection(name)) {
        return section->text();
    }
    if (std::ranges::find(kChoices, name) != kChoices.end()) {
        texts.push_back(choiceText(name));
    }
    for (const ChoiceValue& row : choiceValues()) {
        if (row.name == name) {
            texts.push_back(valueText(row));
        }
    }
    if (const Setting* setting = findSetting(name)) {
        texts.push_back(settingText(*setting));
    }
    for (const Preset& preset : presets()) {
        if (preset.name == name) {
            texts.push_back(presetText(preset));
        }
    }
    for (const worlds::World& world : worlds::all()) {
        if (world.name == name) {
            texts.push_back(worldText(world));
        }
    }
    return fmt::format("{}", fmt::join(texts, "\n"));
}

} // namespace

std::vector<ListedName> listedNames()
{
    std::vector<ListedName> names;
    const auto add = [&names](std::string_view name, std::string_view summary) {
        if (std::ranges::find(names, name, &ListedName::name) == names.end()) {
            names.push_back({name, summary});
        }
    };
    for (const Section& section : kSections) {
        add(section.name, section.summary);
    }
    for (const ChoiceValue& row : choiceValues()) {
        add(row.choice, "a choice");
        add(row.name, row.summary);
    }
    for (const Setting& setting : settingTable()) {
        add(setting.key, setting.doc);
    }
    for (const Preset& preset : presets()) {
        add(preset.name, preset.summary);
    }
    for (const worlds::World& world : worlds::all()) {
        add(world.name, world.summary);
    }
    return names;
}

bool isListed(std::string_view name)
{
    const std::vector<ListedName> names = listedNames();
    return std::ranges::find(names, name, &ListedName::name) != names.end();
}

int runList(const Settings& settings)
{
    if (!settings.topic.empty() && !isListed(settings.topic)) {
        refuseTopic(settings.topic);
    }
    if (!settings.json.empty()) {
        writeResult(settings.json, jsonText(listJson(settings.topic)));
    } else {
        writeStdout(settings.topic.empty() ? overviewText() : topicText(settings.topic));
    }
    return 0;
}

} // namespace gnomon::app
