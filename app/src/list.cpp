// SPDX-License-Identifier: Apache-2.0
// `gnomon list`: every value of every choice, every rule that refuses, every setting, preset and world.
#include "app/preset.h"
#include "claims/claim_report.h"
#include "result_json.h"
#include "streams.h"
#include "subcommands.h"

#include <gnomon/choice_rules.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

constexpr std::string_view kTechniqueGrammar =
    "A technique is values of the choices and KEY=VALUE of technique settings, joined by + in any order; what is left "
    "out has its "
    "default: hard, pcf+pcf.kernel=5x5+map-size=1024. Lists of techniques have commas between.";

/// What does not go together, and why.
struct Refused {
    std::string technique;
    std::string reason;
};

std::vector<Filter> allFilters()
{
    std::vector<Filter> filters;
    for (const ChoiceValue& row : choiceValues()) {
        const auto filter = static_cast<Filter>(row.value);
        if (row.choice == "filter" && filterTraits(filter) != nullptr) {
            filters.push_back(filter);
        }
    }
    return filters;
}

/// The formats that a filter refuses, and why.
struct RefusedFormats {
    std::string filters;
    std::string formats;
    std::string reason;
};

RefusedFormats formatsRefusedBy(Filter filter)
{
    RefusedFormats row{std::string(nameOf(filter)), {}, {}};
    const bool stores = filterTraits(filter)->has_maps;
    for (auto format = MapFormat{}; format <= MapFormat::rg8; format = MapFormat(std::uint8_t(format) + 1)) {
        if (const auto reason = refusal(filter, stores ? format : MapFormat::d16)) {
            row.formats += fmt::format("{}{}", row.formats.empty() ? "" : "|", nameOf(format));
            row.reason = *reason;
        }
    }
    return row;
}

/// One row for all filters that refuse the same formats for the same reason.
void addRefusedFormats(std::vector<Refused>& refused)
{
    std::vector<RefusedFormats> rows;
    for (const Filter filter : allFilters()) {
        RefusedFormats row = formatsRefusedBy(filter);
        const auto same = std::find_if(rows.begin(), rows.end(), [&row](const RefusedFormats& other) {
            return other.formats == row.formats && other.reason == row.reason;
        });
        if (same == rows.end()) {
            rows.push_back(std::move(row));
        } else {
            same->filters += "|" + row.filters;
        }
    }
    for (RefusedFormats& row : rows) {
        refused.push_back({fmt::format("{}+map-format={}", row.filters, row.formats), std::move(row.reason)});
    }
}

/// What a filter's options may not be with a format that it can use: each at the end of its range.
void addRefusedMoments(std::vector<Refused>& refused)
{
    constexpr std::string_view kOptions[] = {"depth-remap=1", "esm.exponent=10000", "evsm.positive=10000",
                                             "evsm.negative=10000"};
    const Settings defaults = defaultSettings();
    for (const Filter filter : allFilters()) {
        for (const std::string_view option : kOptions) {
            for (const MapFormat format : filterTraits(filter)->formats) {
                if (!filterTraits(filter)->has_maps) {
                    continue;
                }
                const std::string text = fmt::format("{}+map-format={}", nameOf(filter), nameOf(format));
                Settings settings = parseTechnique(defaults, text);
                const std::size_t equals = option.find('=');
                const Setting& setting = *findSetting(option.substr(0, equals));
                applySetting(settings, setting, option.substr(equals + 1));
                if (!isUsed(setting, settings)) {
                    continue;
                }
                if (const auto reason = refusal(settings.shadow.technique.filter, format, settings.shadow.moments)) {
                    refused.push_back({fmt::format("{}+{}", text, option), *reason});
                }
            }
        }
    }
}

std::vector<Refused> allRefused()
{
    std::vector<Refused> refused;
    for (const ChoiceRule& rule : choiceRules()) {
        refused.push_back({std::string(rule.refuses), std::string(rule.reason)});
    }
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
    std::string text = "Choices (sources are in --json):\n";
    std::string_view choice;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice != choice) {
            choice = row.choice;
            text += fmt::format("{}\n", choice);
        }
        text += fmt::format("  {:<17} {}\n", row.name, row.summary);
    }
    text += "\nWhat does not go together:\n";
    for (const Refused& row : allRefused()) {
        text += fmt::format("  {}: {}\n", row.technique, row.reason);
    }
    text += "\nSettings (options of their own as --KEY; all by --set KEY=VALUE and, but for outputs, in presets):\n";
    for (const Setting& setting : settingTable()) {
        text += settingLine(setting);
    }
    text += "\nPresets:\n";
    for (const Preset& preset : presets()) {
        text += fmt::format("  {:<20} {}\n", preset.name, preset.summary);
    }
    text += "\nClaims of the source documents, which `gnomon claims` tries:\n";
    for (const ClaimDocument& document : claimDocuments()) {
        for (const Claim& claim : document.claims) {
            text += fmt::format("  {:<26} {}\n", claim.id, claim.claim);
        }
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
        choices.back()["values"].push_back({{"name", row.name}, {"summary", row.summary}, {"source", row.source}});
    }
    return choices;
}

Json jsonList()
{
    Json json{{"version", GNOMON_VERSION}, {"choices", choiceList()}, {"technique_grammar", kTechniqueGrammar}};
    json["refused"] = Json::array();
    for (const Refused& row : allRefused()) {
        json["refused"].push_back({{"technique", row.technique}, {"reason", row.reason}});
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
    json["claims"] = recordedClaimsJson();
    return json;
}

} // namespace

int runList(const Settings& settings)
{
    if (settings.json.empty()) {
        writeStdout(textList());
    } else {
        writeResult(settings.json, jsonText(jsonList()));
    }
    return 0;
}

} // namespace gnomon::app
