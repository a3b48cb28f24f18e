// SPDX-License-Identifier: Apache-2.0
// The options of what is planned: how far shadows reach, and how cascades divide the view. A new one is one row here.
#include "setting_rows.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

bool hasCascades(const Settings& s)
{
    return s.plan.technique.partition == Partition::cascades || s.plan.technique.partition == Partition::sdsm;
}
bool hasSplits(const Settings& s)
{
    return hasCascades(s) && !s.plan.cascades.explicitEnds();
}
bool hasDistance(const Settings& s)
{
    return s.plan.max_distance_m > 0.0;
}

/// Ends hold for their own number of cascades only: of both what is said last holds, and the other says so too.
void applyCount(Settings& s, const Value& v)
{
    s.plan.cascades.count = static_cast<std::uint32_t>(v.integer);
    s.plan.cascades.ends_m = {};
    s.values.erase("cascades.ends");
}

void applyEnds(Settings& s, const Value& v)
{
    double last_m = 0.0;
    for (const double end_m : v.numbers) {
        if (!(end_m > last_m)) {
            throw UsageError("cascades.ends: distances ascend, from above 0");
        }
        last_m = end_m;
    }
    CascadeOptions& cascades = s.plan.cascades;
    cascades.ends_m = {};
    std::copy(v.numbers.begin(), v.numbers.end(), cascades.ends_m.begin());
    cascades.count = static_cast<std::uint32_t>(v.numbers.size()) + 1;
    s.values["cascades.count"] = fmt::format("{}", cascades.count);
}

/// Filterable maps are made one by one.
bool canDrawTogether(const Settings& s)
{
    const FilterTraits* const traits = filterTraits(s.plan.technique.filter);
    return hasCascades(s) && traits != nullptr && !traits->filterable;
}

void applyPass(Settings& s, const Value& v)
{
    const auto names = enumNames<vulkan::CascadePass>(3);
    s.cascade_pass = static_cast<vulkan::CascadePass>(std::find(names.begin(), names.end(), v.text) - names.begin());
}

const std::vector<Setting>& rows()
{
    static const std::vector<Setting> table{
        // clang-format off
        {.key = "max-distance", .group = Group::technique, .type = real, .form = "M", .unit = "m", .default_text = "0", .min = 0, .max = kFarthest,
         .doc = "receivers farther from the eye get no shadow; 0: no limit", .own_option = false,
         .apply = [](Settings& s, const Value& v) { s.plan.max_distance_m = v.real; }},
        {.key = "fade", .group = Group::technique, .type = real, .form = "V", .unit = "of max-distance", .default_text = "0.1", .min = 0, .max = 1,
         .doc = "over which shadows fade away before it", .own_option = false, .used = hasDistance, .used_when = "max-distance above 0",
         .apply = [](Settings& s, const Value& v) { s.plan.fade = v.real; }},
        {.key = "cascades.count", .group = Group::technique, .type = integer, .form = "N", .default_text = "4", .min = 1, .max = kMaxCascades,
         .doc = "slices of the view, each with a map", .own_option = false, .used = hasCascades, .used_when = "partition cascades or sdsm", .apply = applyCount},
        {.key = "cascades.lambda", .group = Group::technique, .type = real, .form = "V", .default_text = "0.75", .min = 0, .max = 1,
         .doc = "1 splits the view logarithmically, 0 evenly", .own_option = false, .used = hasSplits, .used_when = "partition cascades or sdsm without cascades.ends",
         .apply = [](Settings& s, const Value& v) { s.plan.cascades.lambda = v.real; }},
        {.key = "cascades.ends", .group = Group::technique, .type = numbers, .form = "M/M/...", .unit = "m", .min = 0, .max = kFarthest, .count = kMaxCascades - 1, .min_count = 1, .between = '/',
         .doc = "where all cascades but the last end, ascending, as 10/40: one more than these", .own_option = false, .used = hasCascades, .used_when = "partition cascades or sdsm", .apply = applyEnds},
        {.key = "cascades.blend", .group = Group::technique, .type = real, .form = "V", .unit = "of a cascade", .default_text = "0.1", .min = 0, .max = 0.5,
         .doc = "over which one fades into the next", .own_option = false, .used = hasCascades, .used_when = "partition cascades or sdsm",
         .apply = [](Settings& s, const Value& v) { s.plan.cascades.blend = v.real; }},
        {.key = "cascades.pass", .group = Group::technique, .type = choice, .form = "PASS", .default_text = "auto", .choices = [] { return enumNames<vulkan::CascadePass>(3); },
         .doc = "maps drawn each in a pass, or in one with layers; auto: each", .own_option = false, .used = canDrawTogether, .used_when = "filter hard or pcf and partition cascades or sdsm", .apply = applyPass},
        {.key = "border", .group = Group::technique, .type = real, .form = "T", .unit = "texels", .min = 0, .max = 64,
         .doc = "room around the fitted map; else what the kernel needs", .own_option = false,
         .apply = [](Settings& s, const Value& v) { s.plan.border_texels = v.real; s.border_given = true; }},
        // clang-format on
    };
    return table;
}

} // namespace

void addPlanRows(std::vector<Setting>& table)
{
    table.insert(table.end(), rows().begin(), rows().end());
}

} // namespace gnomon::app
