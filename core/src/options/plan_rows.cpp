// SPDX-License-Identifier: Apache-2.0
// The options of what is planned: how far shadows reach, and how cascades divide the view. A new one is one row here.
#include "options/option_access.h"
#include "options/option_rows.h"

#include <gnomon/world_range.h>

#include <algorithm>

namespace gnomon {
namespace {

using enum OptionType;

bool hasCascades(const ShadowOptions& o)
{
    const Partition partition = o.technique.partition;
    const bool divides =
        partition == Partition::cascades || partition == Partition::sdsm || partition == Partition::automatic;
    return divides && hasMaps(o);
}
bool hasSplits(const ShadowOptions& o)
{
    return hasCascades(o) && !o.cascades.explicitEnds();
}
bool hasDistance(const ShadowOptions& o)
{
    return o.max_distance_m > 0.0;
}
/// Filterable maps are made one by one.
bool canDrawTogether(const ShadowOptions& o)
{
    const FilterTraits* const traits = filterTraits(filterOf(o));
    return hasCascades(o) && traits != nullptr && !traits->filterable && !traits->ids;
}

/// Ends hold for their own number of cascades only: of both what is said last holds.
void setCount(ShadowOptions& o, const OptionValue& value)
{
    o.cascades.count = fitted<std::uint32_t>(value.integer);
    o.cascades.ends_m = {};
}
OptionValue getCount(const ShadowOptions& o)
{
    return valueOf(o.cascades.count);
}

void setEnds(ShadowOptions& o, const OptionValue& value)
{
    o.cascades.ends_m = {};
    const std::size_t count = std::min(value.numbers.size(), o.cascades.ends_m.size());
    std::copy_n(value.numbers.begin(), count, o.cascades.ends_m.begin());
    o.cascades.count = static_cast<std::uint32_t>(value.numbers.size()) + 1;
}
OptionValue getEnds(const ShadowOptions& o)
{
    OptionValue value;
    value.none = !o.cascades.explicitEnds();
    for (std::uint32_t i = 0; i + 1 < std::min(o.cascades.count, kMaxCascades); ++i) {
        value.numbers.push_back(o.cascades.ends_m[i]);
    }
    return value;
}

bool isMulti(const ShadowOptions& o)
{
    return o.technique.partition == Partition::multi;
}
bool holdsMulti(const ShadowOptions& o)
{
    return isMulti(o) && o.technique.motion == Motion::snap;
}
bool takesTurns(const ShadowOptions& o)
{
    return boundsDrawing(o);
}
bool hasTurnsOfCascades(const ShadowOptions& o)
{
    return boundsDrawing(o) && o.technique.partition == Partition::cascades;
}
bool isTsm(const ShadowOptions& o)
{
    return o.technique.fit == Fit::tsm && o.technique.partition == Partition::single &&
           o.technique.motion == Motion::free && hasMaps(o);
}
bool hasBlends(const ShadowOptions& o)
{
    return hasCascades(o) || isMulti(o) || segments(o) > 1;
}

} // namespace

void addPlanRows(std::vector<OptionRow>& table)
{
    constexpr std::string_view kCascades = "partition cascades, sdsm or auto";
    const OptionRow rows[]{
        // clang-format off
        {.key = "max-distance", .type = real, .form = "M", .unit = "m", .min = 0, .max = kFarthestPlace_m, .doc = "receivers farther from the eye get no shadow; 0: no limit", GNOMON_MEMBER(max_distance_m)},
        {.key = "fade", .type = real, .form = "V", .unit = "of max-distance", .min = 0, .max = 1, .doc = "over which shadows fade away before it", .used = hasDistance, .used_when = "max-distance above 0", GNOMON_MEMBER(fade)},
        {.key = "cascades.count", .type = integer, .form = "N", .min = 1, .max = kMaxCascades, .doc = "slices of the view, each with a map", .used = hasCascades, .used_when = kCascades, .get = getCount, .set = setCount},
        {.key = "cascades.lambda", .type = real, .form = "V", .min = 0, .max = 1, .doc = "1 splits the view logarithmically, 0 evenly", .used = hasSplits, .used_when = "partition cascades, sdsm or auto without cascades.ends", GNOMON_MEMBER(cascades.lambda)},
        {.key = "cascades.ends", .type = numbers, .form = "M/M/...", .unit = "m", .min = 0, .max = kFarthestPlace_m, .count = kMaxCascades - 1, .doc = "where all cascades but the last end, ascending, as 10/40: one more than these", .used = hasCascades, .used_when = kCascades, .get = getEnds, .set = setEnds},
        {.key = "cascades.blend", .type = real, .form = "V", .unit = "of a cascade", .min = 0, .max = 0.5, .doc = "or segment of tsm, or octave of multi, over which one fades into the next", .used = hasBlends, .used_when = "partition cascades, sdsm, multi or auto, or tsm.segments above 1", GNOMON_MEMBER(cascades.blend)},
        {.key = "cascades.pass", .type = choice, .form = "PASS", .choices = namesOf<CascadePass>, .doc = "maps drawn each in a pass, or in one with layers; auto: each", .used = canDrawTogether, .used_when = "filter hard, pcf, pcss, raymarch, smoothies or auto, and partition cascades, sdsm or auto", GNOMON_MEMBER(cascades.pass)},
        {.key = "cascades.room", .type = real, .form = "V", .unit = "of a cascade", .min = 0, .max = 0.5, .doc = "that maps of all cascades but the first show on each side beyond what is seen, so that each waits for a turn of its own; 0: a light's maps wait together", .used = hasTurnsOfCascades, .used_when = "partition cascades and draw-budget or draw-budget.ms above 0", GNOMON_MEMBER(cascades.room)},
        {.key = "tsm.segments", .type = integer, .form = "N", .min = 1, .max = kMaxCascades, .doc = "affine segments of the trapezoid along the view, each with a map; 1: one projective warp", .used = isTsm, .used_when = "fit tsm, partition single and motion free", GNOMON_MEMBER(tsm_segments)},
        {.key = "multi.divide", .type = choice, .form = "WAY", .choices = namesOf<MultiDivide>, .doc = "space, or receivers gathered into cones of at most 120 degrees", .used = isMulti, .used_when = "partition multi", GNOMON_MEMBER(multi.divide)},
        {.key = "multi.texels-per-pixel", .type = real, .form = "Q", .min = 0.125, .max = 8, .none_text = "auto", .doc = "what multi gives each part of the picture, as long as a light's texels last; auto: 1, and then what is left of them", .used = isMulti, .used_when = "partition multi", GNOMON_MEMBER(multi.texels_per_pixel)},
        {.key = "multi.most-times", .type = real, .form = "X", .min = 0, .max = 1024, .doc = "how many times as many texels a pixel one place may need as another in a frustum of multi; 0: divide where that saves texels, or 4 with multi.divide receivers", .used = isMulti, .used_when = "partition multi", GNOMON_MEMBER(multi.most_times)},
        {.key = "multi.fade", .type = integer, .form = "N", .unit = "frames", .min = 0, .max = 64, .doc = "over which frustums of multi fade over into others, where motion snap has to change them", .used = holdsMulti, .used_when = "partition multi and motion snap", GNOMON_MEMBER(multi.fade_frames)},
        {.key = "budget", .type = integer, .form = "N", .unit = "texels", .min = 0, .max = 34359738368, .doc = "that the maps of all lights may have together; those that the picture owes least to get smaller ones; 0: no limit but memory", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(budget_texels)},
        {.key = "draw-budget", .type = integer, .form = "N", .unit = "texels", .min = 0, .max = 34359738368, .doc = "of maps that may be drawn in one frame; lights whose maps are out of date take turns; 0: no bound", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(draw_budget_texels)},
        {.key = "draw-budget.ms", .type = real, .form = "MS", .unit = "ms", .min = 0, .max = 10000, .doc = "the same bound in the device's time, by what drawing took in frames before; of both the tighter one counts; 0: no bound", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(draw_budget_ms)},
        {.key = "draw-budget.wait", .type = integer, .form = "N", .unit = "frames", .min = 1, .max = 64, .doc = "after which a light or cascade is drawn whatever the draw-budget is", .used = takesTurns, .used_when = "draw-budget or draw-budget.ms above 0", GNOMON_MEMBER(longest_wait)},
        {.key = "border", .type = real, .form = "T", .unit = "texels", .min = 0, .max = 64, .doc = "room around the fitted map; else what the kernel needs", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(border_texels)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

} // namespace gnomon
