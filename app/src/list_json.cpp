// SPDX-License-Identifier: Apache-2.0
#include "list_json.h"

#include "app/preset.h"
#include "doc_pages.h"
#include "list_details.h"
#include "list_rules.h"
#include "worlds/worlds.h"

#include <gnomon/choices.h>

#include <algorithm>

namespace gnomon::app {
namespace {

/// Those that are named so, or of a choice that is; empty: all.
Json choicesNamed(std::string_view name)
{
    Json choices = Json::array();
    for (const ChoiceValue& row : choiceValues()) {
        if (!name.empty() && row.choice != name && row.name != name) {
            continue;
        }
        if (choices.empty() || choices.back()["choice"] != row.choice) {
            choices.push_back({{"choice", row.choice}, {"values", Json::array()}});
        }
        choices.back()["values"].push_back(
            {{"name", row.name}, {"summary", row.summary}, {"source", row.source}, {"page", pageOf(row)}});
    }
    return choices;
}

Json refusedJson(const std::vector<Refused>& refused)
{
    Json rows = Json::array();
    for (const Refused& row : refused) {
        rows.push_back({{"technique", row.technique}, {"reason", row.reason}});
    }
    return rows;
}

/// The rules of all values of that name, each once; all rules where the name is empty.
Json refusedNamed(std::string_view name)
{
    if (name.empty()) {
        return refusedJson(allRefused());
    }
    Json rows = Json::array();
    for (const ChoiceValue& value : choiceValues()) {
        if (value.name != name) {
            continue;
        }
        for (const Json& row : refusedJson(refusedOf(value))) {
            if (std::find(rows.begin(), rows.end(), row) == rows.end()) {
                rows.push_back(row);
            }
        }
    }
    return rows;
}

/// The setting of that name, and those that have an effect with a value of that name.
Json settingsNamed(std::string_view name)
{
    std::vector<const Setting*> chosen;
    for (const ChoiceValue& value : choiceValues()) {
        if (!name.empty() && value.name == name) {
            const std::vector<const Setting*> own = settingsOf(value);
            chosen.insert(chosen.end(), own.begin(), own.end());
        }
    }
    Json rows = Json::array();
    for (const Setting& setting : settingTable()) {
        if (name.empty() || setting.key == name || std::ranges::find(chosen, &setting) != chosen.end()) {
            rows.push_back(settingJson(setting));
        }
    }
    return rows;
}

Json presetsNamed(std::string_view name)
{
    Json rows = Json::array();
    for (const Preset& preset : presets()) {
        if (name.empty() || preset.name == name) {
            rows.push_back(
                {{"name", preset.name}, {"summary", preset.summary}, {"settings", Json::parse(preset.json)}});
        }
    }
    return rows;
}

Json worldsNamed(std::string_view name)
{
    Json rows = Json::array();
    for (const worlds::World& world : worlds::all()) {
        if (name.empty() || world.name == name) {
            rows.push_back({{"name", world.name}, {"summary", world.summary}});
        }
    }
    return rows;
}

struct JsonPart {
    std::string_view section; // the section's name on the command line
    const char* key;
    Json (*rows)(std::string_view name);
};
constexpr JsonPart kParts[] = {{"choices", "choices", choicesNamed},
                               {"rules", "refused", refusedNamed},
                               {"settings", "settings", settingsNamed},
                               {"presets", "presets", presetsNamed},
                               {"worlds", "worlds", worldsNamed}};

} // namespace

Json listJson(std::string_view name)
{
    Json json{{"version", GNOMON_VERSION}};
    for (const JsonPart& part : kParts) {
        if (part.section == name) {
            json["name"] = name;
            json[part.key] = part.rows("");
            return json;
        }
    }
    if (!name.empty()) {
        json["name"] = name;
    }
    for (const JsonPart& part : kParts) {
        Json rows = part.rows(name);
        if (name.empty() || !rows.empty()) {
            json[part.key] = std::move(rows);
        }
        if (name.empty() && part.section == "choices") {
            json["technique_grammar"] = kTechniqueGrammar;
        }
    }
    return json;
}

} // namespace gnomon::app
