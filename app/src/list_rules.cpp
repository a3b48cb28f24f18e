// SPDX-License-Identifier: Apache-2.0
#include "list_rules.h"

#include "app/settings.h"

#include <gnomon/choice_rules.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

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
void addRefusedFormats(std::vector<Refused>& refused, std::span<const Filter> filters)
{
    std::vector<RefusedFormats> rows;
    for (const Filter filter : filters) {
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

/// Adds a filter's options that a format has no room for. Each option is tried at the end of its range.
void addRefusedMoments(std::vector<Refused>& refused, std::span<const Filter> filters)
{
    constexpr std::string_view kOptions[] = {"depth-remap=1", "esm.exponent=10000", "evsm.positive=10000",
                                             "evsm.negative=10000"};
    const Settings defaults = defaultSettings();
    for (const Filter filter : filters) {
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

constexpr std::string_view kChoices[] = {"light", "partition", "fit", "filter", "soften", "motion"};

struct Combination {
    LightType light = LightType::directional;
    Technique technique;
};

void setPart(Combination& combination, const ChoiceValue& row)
{
    Technique& technique = combination.technique;
    if (row.choice == "light") {
        combination.light = static_cast<LightType>(row.value);
    } else if (row.choice == "partition") {
        technique.partition = static_cast<Partition>(row.value);
    } else if (row.choice == "fit") {
        technique.fit = static_cast<Fit>(row.value);
    } else if (row.choice == "filter") {
        technique.filter = static_cast<Filter>(row.value);
    } else if (row.choice == "soften") {
        technique.soften = static_cast<Soften>(row.value);
    } else {
        technique.motion = static_cast<Motion>(row.value);
    }
}

/// Whether a rule refuses the value in this combination, and another value of its choice not.
bool turnsOn(const ChoiceRule& rule, const ChoiceValue& value, Combination combination)
{
    setPart(combination, value);
    if (!rule.applies(combination.light, combination.technique)) {
        return false;
    }
    return std::ranges::any_of(choiceValues(), [&](const ChoiceValue& other) {
        if (other.choice != value.choice) {
            return false;
        }
        setPart(combination, other);
        return !rule.applies(combination.light, combination.technique);
    });
}

/// The same over all combinations of the choices from the first of `choices` on.
bool turnsOnAnywhere(const ChoiceRule& rule, const ChoiceValue& value, std::span<const std::string_view> choices,
                     const Combination& combination)
{
    if (choices.empty()) {
        return turnsOn(rule, value, combination);
    }
    if (choices.front() == value.choice) {
        return turnsOnAnywhere(rule, value, choices.subspan(1), combination);
    }
    return std::ranges::any_of(choiceValues(), [&](const ChoiceValue& row) {
        Combination with = combination;
        setPart(with, row);
        return row.choice == choices.front() && turnsOnAnywhere(rule, value, choices.subspan(1), with);
    });
}

/// Whether the rule's words are about the choice, and not only about an exception to it.
bool speaksOf(const ChoiceRule& rule, std::string_view choice)
{
    std::string_view words = rule.refuses;
    if (words.ends_with(" apart")) {
        words = words.substr(0, words.rfind(", "));
    }
    return words.find(fmt::format("{} ", choice)) != std::string_view::npos;
}

} // namespace

std::vector<Refused> allRefused()
{
    std::vector<Refused> refused;
    for (const ChoiceRule& rule : choiceRules()) {
        refused.push_back({std::string(rule.refuses), std::string(rule.reason)});
    }
    addRefusedFormats(refused, allFilters());
    addRefusedMoments(refused, allFilters());
    return refused;
}

std::vector<Refused> refusedOf(const ChoiceValue& value)
{
    std::vector<Refused> refused;
    for (const ChoiceRule& rule : choiceRules()) {
        if (speaksOf(rule, value.choice) && turnsOnAnywhere(rule, value, kChoices, {})) {
            refused.push_back({std::string(rule.refuses), std::string(rule.reason)});
        }
    }
    const auto filter = static_cast<Filter>(value.value);
    if (value.choice == "filter" && filterTraits(filter) != nullptr) {
        addRefusedFormats(refused, {&filter, 1});
        addRefusedMoments(refused, {&filter, 1});
    }
    return refused;
}

std::vector<StoredAs> storageOfFilters()
{
    std::vector<StoredAs> rows;
    for (const Filter filter : allFilters()) {
        const FilterTraits& traits = *filterTraits(filter);
        const std::span<const MapFormat> formats = traits.has_maps ? traits.formats : std::span<const MapFormat>();
        const auto same = std::ranges::find_if(
            rows, [formats](const StoredAs& row) { return std::ranges::equal(row.formats, formats); });
        if (same == rows.end()) {
            rows.push_back({{nameOf(filter)}, formats});
        } else {
            same->filters.push_back(nameOf(filter));
        }
    }
    return rows;
}

} // namespace gnomon::app
