// SPDX-License-Identifier: Apache-2.0
// The options of the filterable shadow maps: what they store, how they are blurred and read. A new one is one row here.
#include "options/option_access.h"
#include "options/option_rows.h"

#include <algorithm>

namespace gnomon {
namespace {

using enum OptionType;

constexpr std::string_view kFilterable = "filter vsm, lvsm, esm, evsm or msm";
bool isFilterable(const ShadowOptions& o)
{
    const FilterTraits* const traits = filterTraits(filterOf(o));
    return traits != nullptr && traits->filterable;
}
bool hasMetric(const ShadowOptions& o)
{
    const FilterTraits* const traits = filterTraits(filterOf(o));
    return traits != nullptr && traits->has_metric;
}
bool isBlurred(const ShadowOptions& o)
{
    return isFilterable(o) && blurOf(o.moments) != BlurKind::none;
}
bool isGaussian(const ShadowOptions& o)
{
    return isFilterable(o) && blurOf(o.moments) == BlurKind::gaussian;
}
bool isAnisotropic(const ShadowOptions& o)
{
    return isFilterable(o) && o.moments.sampling == MapSampling::anisotropic;
}
bool isLvsm(const ShadowOptions& o)
{
    return filterOf(o) == Filter::lvsm;
}
bool hasWorld(const ShadowOptions& o)
{
    return hasWorldLayers(filterOf(o), o.moments);
}
/// Layers of the world say themselves how depth is counted.
bool canLevel(const ShadowOptions& o)
{
    return isFilterable(o) && !hasWorld(o);
}
/// Layers of the world have ends of their own.
bool overlaps(const ShadowOptions& o)
{
    return isLvsm(o) && !hasWorld(o);
}
bool isEsm(const ShadowOptions& o)
{
    return filterOf(o) == Filter::esm;
}
bool isEvsm(const ShadowOptions& o)
{
    return filterOf(o) == Filter::evsm;
}
bool isMsm(const ShadowOptions& o)
{
    return filterOf(o) == Filter::msm;
}
bool hasVariance(const ShadowOptions& o)
{
    return filterOf(o) == Filter::vsm || isLvsm(o) || isEvsm(o);
}
bool canFollowLight(const ShadowOptions& o)
{
    return filterOf(o) == Filter::vsm || isMsm(o);
}
/// Where it is not so always.
bool canRemap(const ShadowOptions& o)
{
    return isFilterable(o) && !isMsm(o);
}
bool hasExponent(const ShadowOptions& o)
{
    return isEsm(o) || isEvsm(o);
}
bool hasBothWarps(const ShadowOptions& o)
{
    return isEvsm(o) && (formatOf(o) == MapFormat::rgba32f || formatOf(o) == MapFormat::rgba16f);
}

std::vector<std::string_view> sampleCounts()
{
    return {"1", "4"};
}
OptionValue getSamples(const ShadowOptions& o)
{
    OptionValue value;
    value.text = std::to_string(o.moments.samples);
    return value;
}
void setSamples(ShadowOptions& o, const OptionValue& value)
{
    o.moments.samples = value.text == "1" ? 1 : 4;
}

/// 0 texels stand for the kernel's own radius.
OptionValue getRadius(const ShadowOptions& o)
{
    OptionValue value = valueOf(o.moments.blur_radius_texels);
    value.none = value.integer == 0;
    return value;
}
void setRadius(ShadowOptions& o, const OptionValue& value)
{
    o.moments.blur_radius_texels = value.none ? 0 : fitted<std::uint32_t>(value.integer);
}

/// Depths given before hold for layers placed by hand only.
void setPlacement(ShadowOptions& o, const OptionValue& value)
{
    assign(o.moments.placement, value);
    if (o.moments.placement != LayerPlacement::by_hand) {
        o.moments.splits = {};
    }
    if (o.moments.placement != LayerPlacement::world) {
        o.moments.world_layers = {};
    }
}
OptionValue getPlacement(const ShadowOptions& o)
{
    return valueOf(o.moments.placement);
}

void setSplits(ShadowOptions& o, const OptionValue& value)
{
    MomentOptions& moments = o.moments;
    moments.placement = LayerPlacement::by_hand;
    moments.world_layers = {};
    moments.splits = {};
    for (std::size_t i = 0; i < std::min(value.numbers.size(), moments.splits.size()); ++i) {
        moments.splits[i] = static_cast<float>(value.numbers[i]);
    }
}
OptionValue getSplits(const ShadowOptions& o)
{
    OptionValue value;
    value.none = o.moments.placement != LayerPlacement::by_hand;
    for (const float split : o.moments.splits) {
        if (split != 0.0F) {
            value.numbers.push_back(asWritten(split));
        }
    }
    return value;
}

/// Two ends of each layer. As many layers as are said; half a layer is refused by its upper end.
void setWorld(ShadowOptions& o, const OptionValue& value)
{
    MomentOptions& moments = o.moments;
    moments.placement = LayerPlacement::world;
    moments.splits = {};
    moments.world_layers = {};
    const std::size_t count = std::min((value.numbers.size() + 1) / 2, moments.world_layers.size());
    for (std::size_t i = 0; i < count; ++i) {
        const bool whole = 2 * i + 1 < value.numbers.size();
        moments.world_layers[i] = {value.numbers[2 * i], whole ? value.numbers[2 * i + 1] : value.numbers[2 * i]};
    }
    moments.layers = std::max(static_cast<std::uint32_t>(count), 2U); // one alone is refused for want of another
}
OptionValue getWorld(const ShadowOptions& o)
{
    OptionValue value;
    for (const WorldLayer& layer : o.moments.world_layers) {
        if (layer != WorldLayer{}) {
            value.numbers.push_back(layer.low_m);
            value.numbers.push_back(layer.high_m);
        }
    }
    value.none = value.numbers.empty();
    return value;
}

/// How the map is made and read.
void addMapRows(std::vector<OptionRow>& table)
{
    const OptionRow rows[]{
        // clang-format off
        {.key = "msaa", .type = choice, .form = "N", .unit = "samples", .choices = sampleCounts, .doc = "depths taken in a texel, averaged as what is stored", .used = isFilterable, .used_when = kFilterable, .get = getSamples, .set = setSamples},
        {.key = "blur", .type = choice, .form = "KIND", .choices = namesOf<BlurKind>, .doc = "of the map, along rows and then columns; auto: gaussian, none with penumbra light", .used = isFilterable, .used_when = kFilterable, GNOMON_MEMBER(moments.blur)},
        {.key = "blur.sigma", .type = real, .form = "S", .unit = "texels", .min = 0.3, .max = 10, .doc = "standard deviation of the Gaussian", .used = isGaussian, .used_when = "a filterable map and blur gaussian", GNOMON_MEMBER(moments.blur_sigma_texels)},
        {.key = "blur.radius", .type = integer, .form = "N", .unit = "texels", .min = 1, .max = kMaxBlurRadius, .doc = "of the kernel; else three sigma rounded up, 2 of a box", .used = isBlurred, .used_when = "a filterable map and blur gaussian or box", .get = getRadius, .set = setRadius},
        {.key = "blur.path", .type = choice, .form = "PATH", .choices = namesOf<BlurPath>, .doc = "which shaders blur; auto: compute", .used = isBlurred, .used_when = "a filterable map and blur gaussian or box", GNOMON_MEMBER(moments.blur_path)},
        {.key = "map-sampling", .type = choice, .form = "KIND", .choices = namesOf<MapSampling>, .doc = "how the map is read; the last two have mip levels", .used = isFilterable, .used_when = kFilterable, GNOMON_MEMBER(moments.sampling)},
        {.key = "anisotropy", .type = integer, .form = "N", .unit = "reads", .min = 2, .max = 16, .doc = "at most, along the longer side of a pixel's footprint", .used = isAnisotropic, .used_when = "map-sampling anisotropic", GNOMON_MEMBER(moments.anisotropy)},
        {.key = "level-depth", .type = flag, .form = "0|1", .doc = "parallel light: depth from a plane that leans with the receivers", .used = canLevel, .used_when = "a filterable map without layers of the world", GNOMON_MEMBER(level_depth)},
        {.key = "depth-metric", .type = choice, .form = "NAME", .choices = namesOf<DepthMetricKind>, .doc = "what depth is stored; z-over-w is a lamp's alone, and a sun with it is refused", .used = hasMetric, .used_when = "filter hard, pcf, vsm, lvsm, esm, evsm or msm", GNOMON_MEMBER(moments.metric)},
        {.key = "depth-remap", .type = flag, .form = "0|1", .doc = "depth in -1 to 1: a float's sign is precision too", .used = canRemap, .used_when = "filter vsm, lvsm, esm or evsm", GNOMON_MEMBER(moments.remap)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

/// Options of the bound that visibility is made of, and against light bleeding.
void addBoundRows(std::vector<OptionRow>& table)
{
    const OptionRow rows[]{
        // clang-format off
        {.key = "min-variance", .type = real, .form = "V", .unit = "depth^2", .min = 0, .max = 1, .doc = "least variance, depth being 0 to 1; else what rounding and slopes need", .used = hasVariance, .used_when = "filter vsm, lvsm or evsm", GNOMON_MEMBER(moments.min_variance)},
        {.key = "derivative-variance", .type = flag, .form = "0|1", .doc = "a texel's own slope adds to its variance", .used = hasVariance, .used_when = "filter vsm, lvsm or evsm", GNOMON_MEMBER(moments.derivative_variance)},
        {.key = "penumbra", .type = choice, .form = "KIND", .choices = namesOf<MomentPenumbra>, .doc = "edges as wide as the blur, or as the light's size asks", .used = canFollowLight, .used_when = "filter vsm or msm", GNOMON_MEMBER(moments.penumbra)},
        {.key = "bleeding.linstep", .type = real, .form = "V", .unit = "visibility", .min = 0, .max = 0.99, .doc = "up to this is dark, the rest is stretched", .used = isFilterable, .used_when = kFilterable, GNOMON_MEMBER(moments.bleeding_linstep)},
        {.key = "bleeding.power", .type = real, .form = "P", .min = 0.1, .max = 16, .doc = "visibility is raised to this, after linstep", .used = isFilterable, .used_when = kFilterable, GNOMON_MEMBER(moments.bleeding_power)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

/// Options that each belong to one filter.
void addOwnRows(std::vector<OptionRow>& table)
{
    const OptionRow rows[]{
        // clang-format off
        {.key = "lvsm.layers", .type = integer, .form = "N", .unit = "layers", .min = 2, .max = kMaxDepthLayers, .doc = "of depth, two to a texel", .used = isLvsm, .used_when = "filter lvsm", GNOMON_MEMBER(moments.layers)},
        {.key = "lvsm.placement", .type = choice, .form = "NAME", .choices = namesOf<LayerPlacement>, .doc = "gaps: where the least light bleeds; lloyd: where depths gather; hand: lvsm.splits; world: lvsm.world", .used = isLvsm, .used_when = "filter lvsm", .get = getPlacement, .set = setPlacement},
        {.key = "lvsm.splits", .type = numbers, .form = "D/D/...", .unit = "depth", .min = 0, .max = 1, .count = kMaxDepthLayers - 1, .doc = "where layers meet, as 0.3/0.6: above 0, ascending, below 1, one less than layers; means placement hand", .used = isLvsm, .used_when = "filter lvsm", .get = getSplits, .set = setSplits},
        {.key = "lvsm.world", .type = numbers, .form = "M/M/M/M/...", .unit = "m", .min = -1e6, .max = 1e6, .count = 2 * kMaxDepthLayers, .doc = "both ends of each layer of the world, from low to high, as -1/8/20/90; else found; means placement world", .used = isLvsm, .used_when = "filter lvsm", .get = getWorld, .set = setWorld},
        {.key = "lvsm.axis", .type = choice, .form = "NAME", .choices = namesOf<LayerAxis>, .doc = "of layers of the world: metres of height, or along the light", .used = hasWorld, .used_when = "lvsm.placement world", GNOMON_MEMBER(moments.layer_axis)},
        {.key = "lvsm.overlap", .type = real, .form = "V", .unit = "of a layer", .min = 0, .max = 0.5, .doc = "how far a layer reaches into its neighbours", .used = overlaps, .used_when = "filter lvsm without layers of the world", GNOMON_MEMBER(moments.layer_overlap)},
        {.key = "log-space", .type = flag, .form = "0|1", .doc = "store logarithms: any exponent fits any format", .used = hasExponent, .used_when = "filter esm or evsm", GNOMON_MEMBER(moments.log_space)},
        {.key = "esm.exponent", .type = real, .form = "C", .min = 0.01, .max = 10000, .doc = "else 80, or the most that the format holds", .used = isEsm, .used_when = "filter esm", GNOMON_MEMBER(moments.esm_exponent)},
        {.key = "evsm.positive", .type = real, .form = "C", .min = 0.01, .max = 10000, .doc = "exponent; else 40, of two channels 5; at most what the format holds", .used = isEvsm, .used_when = "filter evsm", GNOMON_MEMBER(moments.evsm_positive)},
        {.key = "evsm.negative", .type = real, .form = "C", .min = 0.01, .max = 10000, .doc = "exponent of the second warp; else 5", .used = hasBothWarps, .used_when = "filter evsm and four channels", GNOMON_MEMBER(moments.evsm_negative)},
        {.key = "msm.solver", .type = choice, .form = "NAME", .choices = namesOf<MomentSolver>, .doc = "hausdorff also knows that depth is 0 to 1", .used = isMsm, .used_when = "filter msm", GNOMON_MEMBER(moments.solver)},
        {.key = "msm.bias", .type = real, .form = "V", .min = 0, .max = 0.1, .doc = "how far moments are drawn to ones that can be; else by format", .used = isMsm, .used_when = "filter msm", GNOMON_MEMBER(moments.moment_bias)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

} // namespace

void addMomentRows(std::vector<OptionRow>& table)
{
    addMapRows(table);
    addBoundRows(table);
    addOwnRows(table);
}

} // namespace gnomon
