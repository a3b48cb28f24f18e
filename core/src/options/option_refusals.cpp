// SPDX-License-Identifier: Apache-2.0
#include "option_refusals.h"

#include <gnomon/option_table.h>

#include <algorithm>
#include <cstdint>

namespace gnomon {
namespace {

/// Where cascades end, if the host says so itself.
std::optional<std::string> endsRefusal(const CascadeOptions& options)
{
    double last_m = 0.0;
    for (std::uint32_t i = 0; options.explicitEnds() && i + 1 < options.count; ++i) {
        if (!(options.ends_m[i] > last_m)) {
            return "cascades.ends: distances ascend, from above 0, one fewer than there are cascades";
        }
        last_m = options.ends_m[i];
    }
    return std::nullopt;
}

/// Filters that compare depths keep the rasteriser's depth as it is, and undo the projection where they read it.
std::optional<std::string> metricRefusal(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    const bool compares = traits != nullptr && traits->has_metric && !traits->filterable;
    if (!compares || options.moments.metric != DepthMetricKind::z_over_w) {
        return std::nullopt;
    }
    const MapFormat format = formatOf(options);
    if (format != MapFormat::d32f && format != MapFormat::d24 && format != MapFormat::d16) {
        return "depth-metric z-over-w: it is what the rasteriser keeps by itself, in a map of d32f, d24 or d16";
    }
    if (options.technique.fit != Fit::uniform) {
        return "depth-metric z-over-w: a warp has a w of its own, and the lamp's is shown without one; it needs fit "
               "uniform";
    }
    if (options.technique.partition == Partition::paraboloid) {
        return "depth-metric z-over-w: a paraboloid has distances, which no projection makes; choose linear";
    }
    if (options.faces == CasterFaces::midpoint) {
        return "depth-metric z-over-w: the midpoint of two of its depths is not between the surfaces; choose linear";
    }
    return std::nullopt;
}

/// Ids are of one frame's order, and a map must hold those that the mask reads.
std::optional<std::string> idsRefusal(const ShadowOptions& options)
{
    if (!filterTraits(filterOf(options))->ids) {
        return std::nullopt;
    }
    if (boundsDrawing(options)) {
        return "draw-budget: ids are handed out anew in each frame, and a light that waits has those of an older one";
    }
    if (options.cascades.pass == CascadePass::layered) {
        return "cascades.pass layered: maps of ids are drawn one by one; draw each in a pass of its own";
    }
    if (options.ids.depth == IdDepth::global && filterOf(options) == Filter::id) {
        return "id.depth global: filter id keeps no depth; depth-id does";
    }
    if (options.ids.bias && filterOf(options) == Filter::id) {
        return "id.bias: filter id compares no depths, so there is nothing to move; depth-id has it";
    }
    return std::nullopt;
}

/// Options of maps that are set for a filter without maps.
std::optional<std::string> volumesRefusal(const ShadowOptions& options)
{
    if (hasMaps(options)) {
        return std::nullopt;
    }
    if (options.format) {
        return "map-format: filter volumes counts faces and has no maps; leave it out";
    }
    if (options.budget_texels != 0 || boundsDrawing(options)) {
        return "budget, draw-budget, draw-budget.ms: filter volumes has no maps that could share texels or wait; leave "
               "them out";
    }
    if (options.keep_still == KeepStill::always) {
        return "keep-still always: filter volumes has no maps that could be kept";
    }
    if (options.faces != CasterFaces::nearest) {
        return "caster-faces: filter volumes counts all faces of a closed caster; leave it out";
    }
    if (options.cull != CasterCull::none) {
        return "caster-cull: filter volumes counts all faces of a closed caster; leave it out";
    }
    if (options.mask_size != MaskSize::full) {
        return "mask-size half: filter volumes counts at every pixel, and reads no maps that could be read less often; "
               "take mask-size full";
    }
    if (options.translucent == Translucent::colour) {
        return "translucent colour: filter volumes counts what blocks light, and tints nothing; choose grey or none";
    }
    return std::nullopt;
}

/// The midpoint is found in two images of depth, of all casters of one map.
std::optional<std::string> facesRefusal(const ShadowOptions& options)
{
    if (options.cull != CasterCull::none && options.faces != CasterFaces::nearest) {
        return "caster-cull " + std::string(nameOf(options.cull)) + ": caster-faces " +
               std::string(nameOf(options.faces)) + " says by itself which surfaces count; leave one of them out";
    }
    if (options.faces != CasterFaces::midpoint) {
        return std::nullopt;
    }
    if (filterTraits(filterOf(options))->filterable) {
        return "caster-faces midpoint: an average needs the depth of the receiver itself, which a midpoint is not";
    }
    const MapFormat format = formatOf(options);
    if (format != MapFormat::d32f && format != MapFormat::d16) {
        return "caster-faces midpoint: the two surfaces are depths, so the map is d32f or d16";
    }
    if (options.cascades.pass == CascadePass::layered) {
        return "caster-faces midpoint: a map's second surface needs its first; draw each map in a pass of its own";
    }
    if (options.technique.partition == Partition::paraboloid) {
        return "caster-faces midpoint: paraboloid is no more than a baseline, and its maps hold first surfaces; choose "
               "nearest or back";
    }
    if (options.keep_still == KeepStill::always) {
        return "caster-faces midpoint: what moves may lie between two surfaces of what stands still, so nothing can be "
               "kept apart";
    }
    return std::nullopt;
}

/// The published taps are a recipe of their own.
std::optional<std::string> softenRefusal(const ShadowOptions& options)
{
    const ScreenBlurOptions& blur = options.screen_blur;
    if (options.technique.soften != Soften::blur || blur.taps != ScreenTaps::published) {
        return std::nullopt;
    }
    if (blur.kernel != ScreenKernel::gaussian) {
        return "soften.taps published: these are a Gaussian's; choose soften.kernel gaussian, or soften.taps symmetric";
    }
    if (blur.edges != ScreenEdges::plain) {
        return "soften.taps published: what was published knows no edges, and weights that do are divided by their "
               "sum; choose soften.edges plain, or soften.taps symmetric";
    }
    return std::nullopt;
}

/// Visibility that is clamped at 1 has to be clamped last.
std::optional<std::string> lightenRefusal(const ShadowOptions& options)
{
    const Soften soften = options.technique.soften;
    if (!(options.lighten > 0.0F) || options.lighten_as != LightenAs::add ||
        (soften != Soften::converge && soften != Soften::blur)) {
        return std::nullopt;
    }
    return "lighten.as add: what is cut off at 1 has to be cut off last, and soften " + std::string(nameOf(soften)) +
           " averages after it; take lighten.as remap";
}

std::optional<std::string> budgetRefusal(const ShadowOptions& options)
{
    constexpr std::uint64_t kLeast = 1024;
    const std::uint64_t map = options.map_size ? std::uint64_t{*options.map_size} * *options.map_size : kLeast;
    if (options.budget_texels == 0 || options.budget_texels >= std::max(map, kLeast)) {
        return std::nullopt;
    }
    return "budget is " + std::to_string(options.budget_texels) + "; " +
           (options.budget_texels < kLeast ? "it can be 0, or 1024 and more"
                                           : "one map of map-size has " + std::to_string(map));
}

/// Maps that are of one frame, or have a time of their own, do not wait, so room would cost texels for nothing.
std::optional<std::string> roomRefusal(const ShadowOptions& options)
{
    if (!(options.cascades.room > 0.0)) {
        return std::nullopt;
    }
    if (options.technique.soften == Soften::converge) {
        return "cascades.room: soften converge draws all maps in each frame, so no cascade waits; leave it out";
    }
    if (options.technique.motion != Motion::free && options.technique.motion != Motion::snap) {
        return "cascades.room: maps of a sun that moves in steps do not wait; leave it out";
    }
    return std::nullopt;
}

/// Pages come and go with what is seen, so those of an older frame do not stand for this one's.
std::optional<std::string> pagesRefusal(const ShadowOptions& options)
{
    if (options.technique.partition == Partition::virtual_pages && boundsDrawing(options)) {
        return "draw-budget, draw-budget.ms: partition virtual draws the pages that its picture asks for, and none of "
               "them waits; leave them out";
    }
    return std::nullopt;
}

/// Segments of one frustum's trapezoid, found anew in each frame.
std::optional<std::string> segmentsRefusal(const ShadowOptions& options)
{
    if (segments(options) > 1 && options.technique.partition != Partition::single) {
        return "tsm.segments above 1: they divide the one frustum of partition single; other partitions divide by "
               "themselves";
    }
    if (segments(options) > 1 && options.technique.motion != Motion::free) {
        return "tsm.segments above 1: they follow what each frame shows, so nobody can hold them still; they need "
               "motion free";
    }
    return std::nullopt;
}

std::optional<std::string> smoothiesRefusal(const ShadowOptions& options)
{
    const MapFormat format = formatOf(options);
    if (options.technique.soften == Soften::smoothies &&
        (format == MapFormat::rg16 || format == MapFormat::rg16f || format == MapFormat::rgba8)) {
        return "soften smoothies: edges are looked for in a map that has its texels for itself: d32f, d24, r32f or d16";
    }
    if (filterOf(options) == Filter::smoothies && options.cull != CasterCull::none) {
        return "caster-cull " + std::string(nameOf(options.cull)) +
               ": filter smoothies draws fins of all silhouettes, "
               "those of triangles that are left out too; leave it out, or choose soften smoothies";
    }
    if (hasSmoothies(options) && options.moments.metric == DepthMetricKind::z_over_w) {
        return "smoothies: how far a caster is from its receiver cannot be told from z / w; it needs the linear "
               "metric";
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> refusalOfOptions(const ShadowOptions& options)
{
    if (const auto reason = refusal(options.technique)) {
        return std::string(*reason);
    }
    if (auto reason = firstOutOfRange(options)) {
        return reason;
    }
    if (options.max_layers < 1 || options.max_layers > 2048) {
        return "max_layers is " + std::to_string(options.max_layers) + "; it can be 1 to 2048";
    }
    if (auto reason = volumesRefusal(options)) {
        return reason;
    }
    if (auto reason = budgetRefusal(options)) {
        return reason;
    }
    if (auto reason = endsRefusal(options.cascades)) {
        return reason;
    }
    if (options.technique.soften == Soften::converge && options.keep_still == KeepStill::always) {
        return "keep-still always: soften converge moves its maps in each frame, so nothing of them can be kept";
    }
    if (options.technique.soften == Soften::converge && options.mask_size != MaskSize::full) {
        return "mask-size half: soften converge averages what each pixel itself has seen in many frames, and most "
               "would have seen nothing; take mask-size full";
    }
    if (auto reason = lightenRefusal(options)) {
        return reason;
    }
    if (options.cascades.pass == CascadePass::layered && filterTraits(filterOf(options))->filterable) {
        return "cascades.pass layered: maps that are averaged are made one by one; draw each in a pass of its own";
    }
    if (auto reason = facesRefusal(options)) {
        return reason;
    }
    if (auto reason = metricRefusal(options)) {
        return reason;
    }
    if (auto reason = idsRefusal(options)) {
        return reason;
    }
    if (auto reason = roomRefusal(options)) {
        return reason;
    }
    if (auto reason = pagesRefusal(options)) {
        return reason;
    }
    if (auto reason = segmentsRefusal(options)) {
        return reason;
    }
    if (auto reason = smoothiesRefusal(options)) {
        return reason;
    }
    if (auto reason = softenRefusal(options)) {
        return reason;
    }
    return refusal(filterOf(options), formatOf(options), options.moments);
}

} // namespace gnomon
