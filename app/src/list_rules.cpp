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

/// The formats that a filter refuses, and why: one row for all filters that refuse the same for the same reason.
void addRefusedFormats(std::vector<Refused>& refused, std::span<const Filter> filters)
{
    struct Row {
        std::vector<std::string_view> filters;
        std::vector<std::string_view> formats;
        std::string_view reason;
    };
    std::vector<Row> rows;
    for (const Filter filter : filters) {
        Row row{{nameOf(filter)}, {}, {}};
        const bool stores = filterTraits(filter)->has_maps;
        for (auto format = MapFormat{}; format <= MapFormat::rg8; format = MapFormat(std::uint8_t(format) + 1)) {
            if (const auto reason = refusal(filter, stores ? format : MapFormat::d16)) {
                row.formats.push_back(nameOf(format));
                row.reason = *reason;
            }
        }
        const auto same = std::ranges::find_if(
            rows, [&row](const Row& other) { return other.formats == row.formats && other.reason == row.reason; });
        if (same == rows.end()) {
            rows.push_back(std::move(row));
        } else {
            same->filters.push_back(nameOf(filter));
        }
    }
    for (const Row& row : rows) {
        refused.push_back({fmt::format("{}+map-format={}", fmt::join(row.filters, "|"), fmt::join(row.formats, "|")),
                           std::string(row.reason)});
    }
}

/// Adds a filter's options that a format has no room for. Each option is tried at the end of its range.
void addRefusedMoments(std::vector<Refused>& refused, std::span<const Filter> filters)
{
    constexpr std::pair<std::string_view, std::string_view> kOptions[] = {
        {"depth-remap", "1"}, {"esm.exponent", "10000"}, {"evsm.positive", "10000"}, {"evsm.negative", "10000"}};
    const Settings defaults = defaultSettings();
    for (const Filter filter : filters) {
        for (const auto& [key, value] : kOptions) {
            for (const MapFormat format : filterTraits(filter)->formats) {
                if (!filterTraits(filter)->has_maps) {
                    continue;
                }
                const std::string text = fmt::format("{}+map-format={}", nameOf(filter), nameOf(format));
                Settings settings = parseTechnique(defaults, text);
                applySetting(settings, key, value);
                const auto reason = refusal(settings.shadow.technique.filter, format, settings.shadow.moments);
                if (reason && isUsed(*findSetting(key), settings)) {
                    refused.push_back({fmt::format("{}+{}={}", text, key, value), *reason});
                }
            }
        }
    }
}

} // namespace

std::vector<Refused> allRefused()
{
    std::vector<Refused> refused;
    for (const ChoiceRule& rule : choiceRules()) {
        refused.push_back({rule.refuses(), std::string(rule.reason)});
    }
    addRefusedFormats(refused, allFilters());
    addRefusedMoments(refused, allFilters());
    return refused;
}

std::vector<Refused> refusedOf(const ChoiceValue& value)
{
    std::vector<Refused> refused;
    for (const ChoiceRule& rule : choiceRules()) {
        if (rule.concerns(value)) {
            refused.push_back({rule.refuses(), std::string(rule.reason)});
        }
    }
    const auto filter = static_cast<Filter>(value.value);
    if (value.choice == "filter" && filterTraits(filter) != nullptr) {
        addRefusedFormats(refused, {&filter, 1});
        addRefusedMoments(refused, {&filter, 1});
    }
    return refused;
}

std::vector<std::string_view> formatsOf(const ChoiceValue& value)
{
    std::vector<std::string_view> names;
    const FilterTraits* const traits =
        value.choice == "filter" ? filterTraits(static_cast<Filter>(value.value)) : nullptr;
    if (traits != nullptr && traits->has_maps) {
        for (const MapFormat format : traits->formats) {
            names.push_back(nameOf(format));
        }
    }
    return names;
}

} // namespace gnomon::app
