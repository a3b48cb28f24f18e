// SPDX-License-Identifier: Apache-2.0
#include <gnomon/converge.h>
#include <gnomon/error.h>
#include <gnomon/option_table.h>

#include <pcf_weights.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

template <class Enum, std::size_t n>
std::string_view nameIn(const std::array<std::string_view, n>& names, Enum value)
{
    const auto i = static_cast<std::size_t>(value);
    return i < n ? names[i] : "?";
}

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

/// Of filters that compare depths: what the rasteriser makes of depth is kept as it is, and undone where it is read.
std::optional<std::string> metricRefusal(const ShadowOptions& options)
{
    const Filter filter = filterOf(options);
    const bool compares = filter == Filter::hard || filter == Filter::pcf;
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
    if (options.draw_budget_texels > 0) {
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

/// What is said of maps where there are none.
std::optional<std::string> volumesRefusal(const ShadowOptions& options)
{
    if (hasMaps(options)) {
        return std::nullopt;
    }
    if (options.format) {
        return "map-format: filter volumes counts faces and has no maps; leave it out";
    }
    if (options.budget_texels != 0 || options.draw_budget_texels != 0) {
        return "budget, draw-budget: filter volumes has no maps that could share texels or wait; leave both out";
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

std::optional<std::string> smoothiesRefusal(const ShadowOptions& options)
{
    const MapFormat format = formatOf(options);
    if (options.technique.soften == Soften::smoothies &&
        (format == MapFormat::rg16 || format == MapFormat::rg16f || format == MapFormat::rgba8)) {
        return "soften smoothies: edges are looked for in a map that has its texels for itself: d32f, d24, r32f or d16";
    }
    if (options.technique.soften == Soften::smoothies && options.moments.metric == DepthMetricKind::z_over_w) {
        return "soften smoothies: how far a caster is from its receiver cannot be told from z / w; it needs the linear "
               "metric";
    }
    return std::nullopt;
}

std::optional<std::string> refusalOf(const ShadowOptions& options)
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
    if (options.technique.soften == Soften::converge && options.lighten > 0.0F &&
        options.lighten_as == LightenAs::add) {
        return "lighten.as add: what is cut off at 1 has to be cut off last, and soften converge averages frames after "
               "it; take lighten.as remap";
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
    if (auto reason = smoothiesRefusal(options)) {
        return reason;
    }
    if (auto reason = softenRefusal(options)) {
        return reason;
    }
    return refusal(filterOf(options), formatOf(options), options.moments);
}

/// Of a filter that compares depths, such a texel has two of them, of 16 bits each.
bool holdsTwoMaps(const FilterTraits& traits, MapFormat format)
{
    return !traits.filterable && !traits.ids &&
           (format == MapFormat::rg16 || format == MapFormat::rg16f || format == MapFormat::rgba8);
}

} // namespace

std::string_view nameOf(CascadePass value)
{
    return nameIn(std::array<std::string_view, 3>{"auto", "each", "layered"}, value);
}
std::string_view nameOf(Quality value)
{
    return nameIn(std::array<std::string_view, 3>{"fast", "balanced", "best"}, value);
}
std::string_view nameOf(CasterFaces value)
{
    return nameIn(std::array<std::string_view, 3>{"nearest", "back", "midpoint"}, value);
}
std::string_view nameOf(CasterCull value)
{
    return nameIn(std::array<std::string_view, 3>{"none", "back", "front"}, value);
}
std::string_view nameOf(OpenCasters value)
{
    return nameIn(std::array<std::string_view, 2>{"refuse", "skip"}, value);
}
std::string_view nameOf(Translucent value)
{
    return nameIn(std::array<std::string_view, 3>{"none", "grey", "colour"}, value);
}
std::string_view nameOf(IdTest value)
{
    return nameIn(std::array<std::string_view, 4>{"auto", "any", "priority", "nearest"}, value);
}
std::string_view nameOf(IdDepth value)
{
    return nameIn(std::array<std::string_view, 2>{"object", "global"}, value);
}
std::string_view nameOf(LightenAs value)
{
    return nameIn(std::array<std::string_view, 2>{"remap", "add"}, value);
}
std::string_view nameOf(StepBy value)
{
    return nameIn(std::array<std::string_view, 2>{"angle", "time"}, value);
}
std::string_view nameOf(StepWait value)
{
    return nameIn(std::array<std::string_view, 2>{"none", "camera"}, value);
}
std::string_view nameOf(ScreenKernel value)
{
    return nameIn(std::array<std::string_view, 3>{"gaussian", "box", "poisson"}, value);
}
std::string_view nameOf(ScreenSize value)
{
    return nameIn(std::array<std::string_view, 3>{"full", "half", "quarter"}, value);
}
std::string_view nameOf(ScreenEdges value)
{
    return nameIn(std::array<std::string_view, 2>{"edge-aware", "plain"}, value);
}
std::string_view nameOf(ScreenTaps value)
{
    return nameIn(std::array<std::string_view, 2>{"symmetric", "published"}, value);
}
std::uint32_t pixelsPerTexel(ScreenSize size)
{
    return 1U << static_cast<std::uint32_t>(size);
}
std::string_view nameOf(KeepStill value)
{
    return nameIn(std::array<std::string_view, 3>{"auto", "never", "always"}, value);
}

int kernelWidth(PcfKernel kernel)
{
    switch (kernel) {
    case PcfKernel::bilinear_2x2:
        return 1;
    case PcfKernel::gaussian_3x3:
        return 3;
    case PcfKernel::gaussian_5x5:
        return 5;
    case PcfKernel::gaussian_7x7:
        return 7;
    case PcfKernel::box_3x3:
        return shared::kBoxKernel;
    case PcfKernel::projected_3x3:
        return shared::kProjectedKernel;
    case PcfKernel::poisson:
    case PcfKernel::vogel:
        return 0;
    }
    return 0;
}

Filter filterOf(const ShadowOptions& options)
{
    if (options.technique.filter != Filter::automatic) {
        return options.technique.filter;
    }
    const bool plain = options.quality == Quality::fast || options.technique.partition == Partition::paraboloid ||
                       options.technique.soften == Soften::smoothies;
    return plain ? Filter::pcf : Filter::raymarch;
}

bool hasMaps(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    return traits == nullptr || traits->has_maps;
}

MapFormat formatOf(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    return options.format ? *options.format : traits != nullptr ? traits->formats.front() : MapFormat::d32f;
}

std::uint32_t largestSide(const ShadowOptions& options)
{
    constexpr std::uint32_t kMultiple = 8; // halved three times it is a whole number still
    if (options.map_size) {
        return *options.map_size;
    }
    const std::uint64_t texels = options.budget_texels == 0
                                     ? options.max_texels
                                     : std::min<std::uint64_t>(options.max_texels, options.budget_texels);
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(texels)));
    return std::max(side - side % kMultiple, kMultiple);
}

float reachTexels(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    if (traits != nullptr && traits->filterable) {
        return static_cast<float>(blurRadius(options.moments)) + 1.0F; // and a bilinear read of what was blurred
    }
    if (traits != nullptr && traits->integrates_light) {
        return 2.0F; // from where a ray may start; the way to the light has room of its own
    }
    if (traits != nullptr && traits->ids) {
        return 1.0F; // the four nearest
    }
    if (filterOf(options) != Filter::pcf) {
        return options.technique.soften == Soften::smoothies ? 1.0F : 0.5F; // which are read as pcf 2x2 reads a map
    }
    const int width = kernelWidth(options.pcf.kernel);
    if (width < 0) {
        return 1.5F; // points, a texel away
    }
    return width > 0 ? static_cast<float>(width + 1) * 0.5F : options.pcf.radius_texels + 1.0F;
}

bool fitsOnGpu(const ShadowOptions& options)
{
    const Technique& technique = options.technique;
    return hasMaps(options) && (technique.partition == Partition::sdsm ||
                                (technique.partition == Partition::automatic && options.quality == Quality::best &&
                                 technique.motion == Motion::free));
}

IdTest ResolvedOptions::idTest() const
{
    const IdTest given = asked_.ids.test;
    const IdTest own = filter() == Filter::depth_id ? IdTest::priority : IdTest::any;
    return given == IdTest::automatic ? own : given;
}

bool ResolvedOptions::fitsOnGpu() const
{
    return gnomon::fitsOnGpu(asked_);
}

bool integratesLight(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    return traits != nullptr && (traits->integrates_light || options.technique.soften == Soften::smoothies ||
                                 followsLight(traits->filter, options.moments));
}

bool ResolvedOptions::integratesLight() const
{
    return gnomon::integratesLight(asked_);
}

Resolution resolve(const ShadowOptions& options)
{
    if (auto reason = refusalOf(options)) {
        return {std::nullopt, std::move(*reason)};
    }
    constexpr double kLeastBorder_texels = 4.0;
    // The filter's reach, from wherever the grid is moved to.
    const double needed_texels = static_cast<double>(reachTexels(options)) +
                                 (options.technique.soften == Soften::converge ? kMostGridMove_texels : 0.0);
    ResolvedOptions made;
    made.asked_ = options;
    made.asked_.technique.filter = filterOf(options);
    if (options.technique.partition == Partition::paraboloid) {
        made.asked_.technique.fit = Fit::uniform; // auto
    }
    if (options.technique.fit == Fit::scene) {
        made.asked_.technique.partition = Partition::single; // auto
    }
    if (!hasMaps(options)) {
        made.asked_.technique.partition = Partition::single; // auto
        made.asked_.technique.fit = Fit::uniform;
    }
    made.traits_ = filterTraits(filterOf(options));
    made.format_ = formatOf(options);
    made.largest_side_ = largestSide(options);
    made.reach_texels_ = reachTexels(options);
    made.border_texels_ = options.border_texels.value_or(std::max(kLeastBorder_texels, std::ceil(needed_texels)));
    made.paired_maps_ = holdsTwoMaps(*made.traits_, made.format_);
    return {made, {}};
}

ResolvedOptions resolvedOrThrow(const ShadowOptions& options)
{
    Resolution resolution = resolve(options);
    if (!resolution) {
        throw Error("choose how shadows are made", resolution.refusal);
    }
    return *resolution;
}

} // namespace gnomon
