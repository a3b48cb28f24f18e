// SPDX-License-Identifier: Apache-2.0
// The options of the filterable shadow maps: what they store, how they are blurred and read. A new one is one row here.
#include "setting_rows.h"

#include <gnomon/moment_options.h>

#include <algorithm>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

template <typename Enum>
void setNamed(Enum& target, const Value& value, std::uint8_t count)
{
    const auto names = enumNames<Enum>(count);
    target = static_cast<Enum>(std::find(names.begin(), names.end(), value.text) - names.begin());
}

void applySplits(Settings& s, const Value& v)
{
    MomentOptions& moments = s.filter.moments;
    moments.placement = LayerPlacement::by_hand;
    moments.splits = {};
    std::transform(v.numbers.begin(), v.numbers.end(), moments.splits.begin(),
                   [](double depth) { return static_cast<float>(depth); });
    s.splits = static_cast<std::uint32_t>(v.numbers.size());
}

/// Depths given before hold for layers placed by hand only.
void applyPlacement(Settings& s, const Value& v)
{
    setNamed(s.filter.moments.placement, v, 3);
    if (s.filter.moments.placement != LayerPlacement::by_hand) {
        s.filter.moments.splits = {};
        s.splits = 0;
    }
}

constexpr std::string_view kFilterable = "filter vsm, lvsm, esm, evsm or msm";
bool isFilterable(const Settings& s)
{
    const FilterTraits* traits = filterTraits(s.plan.technique.filter);
    return traits != nullptr && traits->filterable;
}
bool isBlurred(const Settings& s)
{
    return isFilterable(s) && s.filter.moments.blur != BlurKind::none;
}
bool isGaussian(const Settings& s)
{
    return isFilterable(s) && s.filter.moments.blur == BlurKind::gaussian;
}
bool isAnisotropic(const Settings& s)
{
    return isFilterable(s) && s.filter.moments.sampling == MapSampling::anisotropic;
}
bool isLvsm(const Settings& s)
{
    return s.plan.technique.filter == Filter::lvsm;
}
bool isEsm(const Settings& s)
{
    return s.plan.technique.filter == Filter::esm;
}
bool isEvsm(const Settings& s)
{
    return s.plan.technique.filter == Filter::evsm;
}
bool isMsm(const Settings& s)
{
    return s.plan.technique.filter == Filter::msm;
}
bool hasVariance(const Settings& s)
{
    return s.plan.technique.filter == Filter::vsm || isLvsm(s) || isEvsm(s);
}
/// Where it is not so always.
bool canRemap(const Settings& s)
{
    return isFilterable(s) && !isMsm(s);
}
bool hasExponent(const Settings& s)
{
    return isEsm(s) || isEvsm(s);
}
bool hasBothWarps(const Settings& s)
{
    return isEvsm(s) && (s.filter.format == MapFormat::rgba32f || s.filter.format == MapFormat::rgba16f);
}

/// How the map is made and read.
void addMapRows(std::vector<Setting>& table)
{
    const std::vector<Setting> rows{
        // clang-format off
        {.key = "msaa", .group = Group::technique, .type = choice, .form = "N", .unit = "samples", .default_text = "4", .choices = [] { return std::vector<std::string_view>{"1", "4"}; },
         .doc = "depths taken in a texel, averaged as what is stored", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { s.filter.moments.samples = v.text == "1" ? 1 : 4; }},
        {.key = "blur", .group = Group::technique, .type = choice, .form = "KIND", .default_text = "gaussian", .choices = [] { return enumNames<BlurKind>(3); },
         .doc = "of the map, along rows and then columns", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { setNamed(s.filter.moments.blur, v, 3); }},
        {.key = "blur.sigma", .group = Group::technique, .type = real, .form = "S", .unit = "texels", .default_text = "1.25", .min = 0.3, .max = 10,
         .doc = "standard deviation of the Gaussian", .own_option = false, .used = isGaussian, .used_when = "a filterable map and blur gaussian",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.blur_sigma_texels = static_cast<float>(v.real); }},
        {.key = "blur.radius", .group = Group::technique, .type = integer, .form = "N", .unit = "texels", .min = 1, .max = kMaxBlurRadius,
         .doc = "of the kernel; else three sigma rounded up, 2 of a box", .own_option = false, .used = isBlurred, .used_when = "a filterable map and blur gaussian or box",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.blur_radius_texels = static_cast<std::uint32_t>(v.integer); }},
        {.key = "blur.path", .group = Group::technique, .type = choice, .form = "PATH", .default_text = "auto", .choices = [] { return enumNames<BlurPath>(3); },
         .doc = "which shaders blur; auto: compute", .own_option = false, .used = isBlurred, .used_when = "a filterable map and blur gaussian or box",
         .apply = [](Settings& s, const Value& v) { setNamed(s.filter.moments.blur_path, v, 3); }},
        {.key = "map-sampling", .group = Group::technique, .type = choice, .form = "KIND", .default_text = "bilinear", .choices = [] { return enumNames<MapSampling>(4); },
         .doc = "how the map is read; the last two have mip levels", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { setNamed(s.filter.moments.sampling, v, 4); }},
        {.key = "anisotropy", .group = Group::technique, .type = integer, .form = "N", .unit = "reads", .default_text = "8", .min = 2, .max = 16,
         .doc = "at most, along the longer side of a pixel's footprint", .own_option = false, .used = isAnisotropic, .used_when = "map-sampling anisotropic",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.anisotropy = static_cast<std::uint32_t>(v.integer); }},
        {.key = "level-depth", .group = Group::technique, .type = flag, .form = "0|1", .default_text = "1",
         .doc = "parallel light: depth from a plane that leans with the receivers", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { s.plan.level_depth = v.flag; }},
        {.key = "depth-metric", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "linear", .choices = [] { return enumNames<DepthMetricKind>(2); },
         .doc = "what depth is stored; z-over-w differs under spot lights alone", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { setNamed(s.filter.moments.metric, v, 2); }},
        {.key = "depth-remap", .group = Group::technique, .type = flag, .form = "0|1", .default_text = "0",
         .doc = "depth in -1 to 1: a float's sign is precision too", .own_option = false, .used = canRemap, .used_when = "filter vsm, lvsm, esm or evsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.remap = v.flag; }},
        // clang-format on
    };
    table.insert(table.end(), rows.begin(), rows.end());
}

/// What visibility is made of, and against what it bleeds.
void addBoundRows(std::vector<Setting>& table)
{
    const std::vector<Setting> rows{
        // clang-format off
        {.key = "min-variance", .group = Group::technique, .type = real, .form = "V", .unit = "depth^2", .min = 0, .max = 1,
         .doc = "least variance, depth being 0 to 1; else what rounding and slopes need", .own_option = false, .used = hasVariance, .used_when = "filter vsm, lvsm or evsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.min_variance = static_cast<float>(v.real); }},
        {.key = "derivative-variance", .group = Group::technique, .type = flag, .form = "0|1", .default_text = "0",
         .doc = "a texel's own slope adds to its variance", .own_option = false, .used = hasVariance, .used_when = "filter vsm, lvsm or evsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.derivative_variance = v.flag; }},
        {.key = "bleeding.linstep", .group = Group::technique, .type = real, .form = "V", .unit = "visibility", .default_text = "0", .min = 0, .max = 0.99,
         .doc = "up to this is dark, the rest is stretched", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { s.filter.moments.bleeding_linstep = static_cast<float>(v.real); }},
        {.key = "bleeding.power", .group = Group::technique, .type = real, .form = "P", .default_text = "1", .min = 0.1, .max = 16,
         .doc = "visibility is raised to this, after linstep", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { s.filter.moments.bleeding_power = static_cast<float>(v.real); }},
        {.key = "lighten", .group = Group::technique, .type = real, .form = "V", .unit = "visibility", .default_text = "0", .min = 0, .max = 1,
         .doc = "what full shadow becomes, last of all", .own_option = false, .used = isFilterable, .used_when = kFilterable,
         .apply = [](Settings& s, const Value& v) { s.filter.moments.lighten = static_cast<float>(v.real); }},
        // clang-format on
    };
    table.insert(table.end(), rows.begin(), rows.end());
}

/// Of one filter each.
void addOwnRows(std::vector<Setting>& table)
{
    const std::vector<Setting> rows{
        // clang-format off
        {.key = "lvsm.layers", .group = Group::technique, .type = integer, .form = "N", .unit = "layers", .default_text = "2", .min = 2, .max = kMaxDepthLayers,
         .doc = "of depth, two to a texel", .own_option = false, .used = isLvsm, .used_when = "filter lvsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.layers = static_cast<std::uint32_t>(v.integer); }},
        {.key = "lvsm.placement", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "lloyd", .choices = [] { return enumNames<LayerPlacement>(3); },
         .doc = "hand: lvsm.splits; lloyd: where the map's depths gather", .own_option = false, .used = isLvsm, .used_when = "filter lvsm", .apply = applyPlacement},
        {.key = "lvsm.splits", .group = Group::technique, .type = numbers, .form = "D/D/...", .unit = "depth", .min = 0, .max = 1, .count = kMaxDepthLayers - 1, .min_count = 1, .between = '/',
         .doc = "where layers meet, as 0.3/0.6: above 0, ascending, below 1, one less than layers; means placement hand", .own_option = false, .used = isLvsm, .used_when = "filter lvsm", .apply = applySplits},
        {.key = "lvsm.overlap", .group = Group::technique, .type = real, .form = "V", .unit = "of a layer", .default_text = "0.05", .min = 0, .max = 0.5,
         .doc = "how far a layer reaches into its neighbours", .own_option = false, .used = isLvsm, .used_when = "filter lvsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.layer_overlap = static_cast<float>(v.real); }},
        {.key = "log-space", .group = Group::technique, .type = flag, .form = "0|1", .default_text = "0",
         .doc = "store logarithms: any exponent fits any format", .own_option = false, .used = hasExponent, .used_when = "filter esm or evsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.log_space = v.flag; }},
        {.key = "esm.exponent", .group = Group::technique, .type = real, .form = "C", .min = 0.01, .max = 10000,
         .doc = "else 80, or the most that the format holds", .own_option = false, .used = isEsm, .used_when = "filter esm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.esm_exponent = static_cast<float>(v.real); }},
        {.key = "evsm.positive", .group = Group::technique, .type = real, .form = "C", .min = 0.01, .max = 10000,
         .doc = "exponent; else 40, of two channels 5; at most what the format holds", .own_option = false, .used = isEvsm, .used_when = "filter evsm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.evsm_positive = static_cast<float>(v.real); }},
        {.key = "evsm.negative", .group = Group::technique, .type = real, .form = "C", .min = 0.01, .max = 10000,
         .doc = "exponent of the second warp; else 5", .own_option = false, .used = hasBothWarps, .used_when = "filter evsm and four channels",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.evsm_negative = static_cast<float>(v.real); }},
        {.key = "msm.solver", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "hamburger", .choices = [] { return enumNames<MomentSolver>(2); },
         .doc = "hausdorff also knows that depth is 0 to 1", .own_option = false, .used = isMsm, .used_when = "filter msm",
         .apply = [](Settings& s, const Value& v) { setNamed(s.filter.moments.solver, v, 2); }},
        {.key = "msm.bias", .group = Group::technique, .type = real, .form = "V", .min = 0, .max = 0.1,
         .doc = "how far moments are drawn to ones that can be; else by format", .own_option = false, .used = isMsm, .used_when = "filter msm",
         .apply = [](Settings& s, const Value& v) { s.filter.moments.moment_bias = static_cast<float>(v.real); }},
        // clang-format on
    };
    table.insert(table.end(), rows.begin(), rows.end());
}

} // namespace

void addMomentRows(std::vector<Setting>& table)
{
    addMapRows(table);
    addBoundRows(table);
    addOwnRows(table);
}

} // namespace gnomon::app
