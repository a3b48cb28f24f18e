// SPDX-License-Identifier: Apache-2.0
// `gnomon list`: the choices and what they refuse on a few screens; with a name, all there is to say of it.
#include "list.h"

#include "app/command_line.h"
#include "list_rules.h"
#include "streams.h"
#include "subcommands.h"
#include "topics.h"
#include "wrap_text.h"

#include <gnomon/choice_rules.h>
#include <gnomon/option_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::app {
namespace {

constexpr std::string_view kTechniqueGrammar =
    "A technique is values of the choices and KEY=VALUE of technique settings, joined by + in any order; what is left "
    "out has its default: hard, pcf+pcf.kernel=5x5+map-size=1024. Lists of techniques have commas between.";

/// How a section's rows are listed.
struct Section {
    std::string_view name;
    const char* json_key;
    std::string_view heading;
    std::size_t column; // where the summaries begin
};
constexpr std::array kSections{
    Section{"choices", "choices", "", 18}, Section{"rules", "refused", "What does not go together, and why:\n", 0},
    Section{"settings", "settings",
            "Settings (options of their own as --KEY; all by --set KEY=VALUE, and in presets all except outputs):\n",
            22},
    Section{"presets", "presets", "Presets, for --preset:\n", 18},
    Section{"worlds", "worlds", "Built-in worlds, in the place of a scene's file:\n", 12}};

const Section& sectionOf(std::string_view name)
{
    return *std::ranges::find(kSections, name, &Section::name);
}

/// The setting that takes a choice's value; null for light, whose values are the scene's.
const Setting* settingOf(std::string_view choice)
{
    return findOption(choice) != nullptr ? findSetting(choice) : nullptr;
}

std::string settingText(const Setting& setting)
{
    std::vector<std::string> facts;
    if (!setting.unit.empty()) {
        facts.emplace_back(setting.unit);
    }
    if (!setting.default_text.empty()) {
        facts.push_back(fmt::format("default {}", setting.default_text));
    }
    if (setting.min < setting.max) {
        facts.push_back(fmt::format("{} to {}", setting.min, setting.max));
    }
    if (setting.choices != nullptr) {
        facts.push_back("one of " + joined(setting.choices()));
    }
    if (!setting.used_when.empty()) {
        facts.push_back(fmt::format("with {}", setting.used_when));
    }
    return facts.empty() ? std::string(setting.doc) : fmt::format("{} [{}]", setting.doc, fmt::join(facts, ", "));
}

std::string lineOf(const Topic& topic)
{
    if (topic.name == topic.choice) { // a heading of its values
        const Setting* const setting = settingOf(topic.choice);
        return setting == nullptr ? fmt::format("{}: what casts\n", topic.choice)
                                  : fmt::format("{}: {} ({})\n", topic.choice, setting->doc, setting->default_text);
    }
    return entryText(topic.name, topic.setting != nullptr ? settingText(*topic.setting) : std::string(topic.summary),
                     sectionOf(topic.section).column);
}

std::string refusedText(const std::vector<Refused>& refused)
{
    std::string text;
    for (const Refused& row : refused) {
        text += wrapped("  ", fmt::format("{}: {}", row.technique, row.reason), 4);
    }
    return text;
}

std::string sectionText(const Section& section)
{
    std::string text(section.heading);
    for (const Topic& topic : topics()) {
        if (topic.section == section.name) {
            text += lineOf(topic);
        }
    }
    return section.name == "rules" ? text + refusedText(allRefused()) : text;
}

/// The formats in which filters are stored: a line for all that are stored alike.
std::string storageText()
{
    std::vector<std::pair<std::string, std::string>> rows; // formats, filters
    for (const ChoiceValue& value : choiceValues()) {
        if (value.choice != "filter" || value.name == "auto") { // which is one of the others
            continue;
        }
        const std::string formats = joined(formatsOf(value));
        if (const auto same = std::ranges::find(rows, formats, &decltype(rows)::value_type::first);
            same == rows.end()) {
            rows.emplace_back(formats, value.name);
        } else {
            same->second += fmt::format(" {}", value.name);
        }
    }
    std::string text;
    for (const auto& [formats, filters] : rows) {
        text += entryText(filters, formats.empty() ? "no map, so no format" : formats, 28);
    }
    return text;
}

/// The names of a section's rows on a line.
std::string namesLine(std::string_view section)
{
    std::vector<std::string_view> names;
    for (const Topic& topic : topics()) {
        if (topic.section == section) {
            names.push_back(topic.name);
        }
    }
    return section.empty() ? entryText("gnomon list", joined(names, "|"), 14) : entryText(section, joined(names), 14);
}

/// A few screens.
std::string overviewText()
{
    std::string text = wrapped("", kTechniqueGrammar, 0) + "\n" + sectionText(sectionOf("choices")) +
                       "\nRefused, before anything is drawn:\n";
    for (const ChoiceRule& rule : choiceRules()) {
        text += wrapped("  ", rule.reason, 4);
    }
    text += "\nMap formats, the usual one first; a filter refuses all others (`gnomon list rules` says why):\n" +
            storageText() + "\n" +
            wrapped("",
                    "One name in full: `gnomon list msm` has a value's settings, rules and source; so have "
                    "`list pcf.kernel` a setting, and `list rts` a world. All of a kind:",
                    0) +
            namesLine("") + namesLine("presets") + namesLine("worlds");
    std::vector<std::string_view> names(subcommands().size());
    std::ranges::transform(subcommands(), names.begin(), &Subcommand::name);
    return text + entryText("subcommands", joined(names), 14) +
           "`gnomon SUBCOMMAND --help` has a subcommand's options; --json has all of this for scripts.\n";
}

std::string choiceText(const Topic& topic)
{
    const Setting* const setting = settingOf(topic.choice);
    std::string text =
        fmt::format("{}, a choice: {}\n", topic.choice,
                    setting == nullptr ? "what casts; each light of the scene is one of them" : setting->doc);
    for (const Topic& row : topics()) {
        text += row.value != nullptr && row.choice == topic.choice ? entryText(row.name, row.summary, 20) : "";
    }
    return setting == nullptr ? text
                              : text + fmt::format("Without a word it is {}. `gnomon list VALUE` has settings, rules "
                                                   "and source of each.\n",
                                                   setting->default_text);
}

std::string topicText(const Topic& topic)
{
    if (topic.section.empty()) {
        return sectionText(sectionOf(topic.name));
    }
    if (topic.name == topic.choice) {
        return choiceText(topic);
    }
    const std::string kind = topic.value != nullptr     ? fmt::format("a value of {}", topic.choice)
                             : topic.setting != nullptr ? "a setting"
                             : topic.preset != nullptr  ? "a preset"
                                                        : "a built-in world";
    std::string text = wrapped(fmt::format("{}, {}: ", topic.name, kind), topic.summary, 2);
    for (const Fact& fact : factsOf(topic)) {
        text += fact.text.empty() ? "" : entryText(fact.name, fact.text, 15);
    }
    if (topic.value != nullptr) {
        const std::vector<const Setting*> own = settingsOf(*topic.value);
        text += own.empty() ? "" : "Settings of its own, by --set KEY=VALUE, in presets and techniques:\n";
        for (const Setting* setting : own) {
            text += entryText(setting->key, settingText(*setting), sectionOf("settings").column);
        }
        const std::vector<Refused> refused = refusedOf(*topic.value);
        text += refused.empty() ? "" : "Refused:\n" + refusedText(refused);
    }
    return topic.preset != nullptr ? text + fmt::format("{}\n", topic.preset->json) : text;
}

/// Everything of that name: `blur` is a value and a setting.
std::string textNamed(std::string_view name)
{
    std::vector<std::string> texts;
    for (const Topic& topic : topics()) {
        if (topic.name == name) {
            texts.push_back(topicText(topic));
        }
    }
    return fmt::format("{}", fmt::join(texts, "\n"));
}

[[noreturn]] void refuseTopic(std::string_view name)
{
    std::vector<std::string_view> names;
    for (const Subcommand& subcommand : subcommands()) {
        if (subcommand.name == name) {
            throw UsageError(fmt::format("list: {0} is a subcommand; see `gnomon {0} --help`", name));
        }
    }
    for (const Topic& topic : topics()) {
        names.push_back(topic.name);
    }
    throw UsageError(fmt::format("list has nothing called \"{}\"{}; `gnomon list` shows what there is", name,
                                 suggestion(name, names)));
}

/// All that is refused; with a name, the rules of the values of that name, each once.
Json refusedJson(std::string_view name)
{
    Json rows = Json::array();
    const auto add = [&rows](const std::vector<Refused>& refused) {
        for (const Refused& row : refused) {
            Json json{{"technique", row.technique}, {"reason", row.reason}};
            if (std::find(rows.begin(), rows.end(), json) == rows.end()) {
                rows.push_back(std::move(json));
            }
        }
    };
    if (name.empty()) {
        add(allRefused());
    }
    for (const ChoiceValue& value : choiceValues()) {
        if (value.name == name) {
            add(refusedOf(value));
        }
    }
    return rows;
}

Json topicJson(const Topic& topic)
{
    if (topic.setting != nullptr) {
        return settingJson(*topic.setting);
    }
    Json json{{"name", topic.name}, {"summary", topic.summary}};
    if (topic.value != nullptr) {
        json["source"] = topic.value->source;
        json["page"] = pageOf(topic);
    } else if (topic.preset != nullptr) {
        json["settings"] = Json::parse(topic.preset->json);
    }
    return json;
}

/// A section's rows; with a name, those of that name, a choice's values and a value's settings. Values are under their
/// choices.
Json rowsJson(std::string_view section, std::string_view name)
{
    std::vector<const Setting*> own;
    for (const ChoiceValue& value : choiceValues()) {
        if (value.name == name) {
            const std::vector<const Setting*> more = settingsOf(value);
            own.insert(own.end(), more.begin(), more.end());
        }
    }
    Json rows = Json::array();
    for (const Topic& topic : topics()) {
        const bool is_own = topic.setting != nullptr && std::ranges::find(own, topic.setting) != own.end();
        const bool is_meant = name.empty() || topic.name == name || topic.choice == name || is_own;
        if (topic.section != section || topic.name == topic.choice || !is_meant) {
            continue;
        }
        if (topic.value == nullptr) {
            rows.push_back(topicJson(topic));
            continue;
        }
        if (rows.empty() || rows.back()["choice"] != topic.choice) {
            rows.push_back({{"choice", topic.choice}, {"values", Json::array()}});
        }
        rows.back()["values"].push_back(topicJson(topic));
    }
    return rows;
}

} // namespace

Json listJson(std::string_view name)
{
    Json json{{"version", GNOMON_VERSION}};
    if (!name.empty()) {
        json["name"] = name;
    }
    const bool is_section = std::ranges::find(kSections, name, &Section::name) != kSections.end();
    const std::string_view rows_named = is_section ? "" : name;
    for (const Section& section : kSections) {
        if (is_section && section.name != name) {
            continue;
        }
        Json rows = section.name == "rules" ? refusedJson(rows_named) : rowsJson(section.name, rows_named);
        if (rows_named.empty() || !rows.empty()) {
            json[section.json_key] = std::move(rows);
        }
        if (name.empty() && section.name == "choices") {
            json["technique_grammar"] = kTechniqueGrammar;
        }
    }
    return json;
}

int runList(const Settings& settings)
{
    if (!settings.topic.empty() && !isListed(settings.topic)) {
        refuseTopic(settings.topic);
    }
    if (!settings.json.empty()) {
        writeResult(settings.json, jsonText(listJson(settings.topic)));
    } else {
        writeStdout(settings.topic.empty() ? overviewText() : textNamed(settings.topic));
    }
    return 0;
}

} // namespace gnomon::app
