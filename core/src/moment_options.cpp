// SPDX-License-Identifier: Apache-2.0
#include <gnomon/option_table.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 2> kMetrics{"linear", "z-over-w"};
constexpr std::array<std::string_view, 4> kBlurs{"auto", "none", "gaussian", "box"};
constexpr std::array<std::string_view, 3> kPaths{"auto", "compute", "fragment"};
constexpr std::array<std::string_view, 4> kSamplings{"nearest", "bilinear", "trilinear", "anisotropic"};
constexpr std::array<std::string_view, 5> kPlacements{"uniform", "hand", "lloyd", "gaps", "world"};
constexpr std::array<std::string_view, 2> kAxes{"height", "light"};
constexpr std::array<std::string_view, 2> kPenumbrae{"fixed", "light"};
constexpr std::array<std::string_view, 2> kSolvers{"hamburger", "hausdorff"};

template <class Enum, std::size_t n>
std::string_view nameIn(const std::array<std::string_view, n>& names, Enum value)
{
    const auto i = static_cast<std::size_t>(value);
    return i < n ? names[i] : "?";
}

bool isHalf(MapFormat format)
{
    return format == MapFormat::r16f || format == MapFormat::rg16f || format == MapFormat::rgba16f;
}
bool isUnorm(MapFormat format)
{
    return format == MapFormat::rg16 || format == MapFormat::rgba16;
}
bool hasFourChannels(MapFormat format)
{
    return format == MapFormat::rgba16 || format == MapFormat::rgba16f || format == MapFormat::rgba32f;
}

/// As one would write it: the fewest digits that single precision tells apart, in every locale.
std::string textOf(float value)
{
    std::array<char, 32> room{};
    return {room.data(), std::to_chars(room.data(), room.data() + room.size(), value).ptr};
}

std::optional<std::string> exponentRefusal(std::string_view name, const std::optional<float>& wish, MapFormat format,
                                           double largest)
{
    if (!wish) {
        return std::nullopt;
    }
    if (static_cast<double>(*wish) > largest) {
        return std::string(name) + " " + textOf(*wish) + " would overflow " + std::string(nameOf(format)) +
               ", which holds up to " + textOf(static_cast<float>(largest)) + "; in log space there is no such limit";
    }
    return std::nullopt;
}

constexpr double kFarthestLayer_m = 1e6;

std::optional<std::string> worldRefusal(const MomentOptions& o)
{
    if (o.placement != LayerPlacement::world) {
        return std::nullopt;
    }
    if (o.metric == DepthMetricKind::z_over_w) {
        return "layers of the world are metres of it, in which depth is counted along the light: depth-metric linear";
    }
    const auto given = static_cast<std::size_t>(std::find(o.world_layers.begin(), o.world_layers.end(), WorldLayer{}) -
                                                o.world_layers.begin());
    if (o.world_layers == std::array<WorldLayer, kMaxDepthLayers>{}) {
        return std::nullopt; // the frame's, or found
    }
    if (given != o.layers) {
        return "each layer of the world has two ends: " + std::to_string(o.layers) +
               " layers need so many pairs, and " + std::to_string(given) + (given == 1 ? " is" : " are") + " given";
    }
    return refusal(std::span(o.world_layers).first(given));
}

std::optional<std::string> splitRefusal(const MomentOptions& o)
{
    float last = 0.0F;
    for (std::uint32_t i = 0; o.placement == LayerPlacement::by_hand && i + 1 < o.layers; ++i) {
        if (!(o.splits[i] > last && o.splits[i] < 1.0F)) {
            return "layers placed by hand meet at ascending depths between 0 and 1, one fewer than there are layers";
        }
        last = o.splits[i];
    }
    return std::nullopt;
}

} // namespace

std::string_view nameOf(DepthMetricKind value)
{
    return nameIn(kMetrics, value);
}
std::string_view nameOf(BlurKind value)
{
    return nameIn(kBlurs, value);
}
std::string_view nameOf(BlurPath value)
{
    return nameIn(kPaths, value);
}
std::string_view nameOf(MapSampling value)
{
    return nameIn(kSamplings, value);
}
std::string_view nameOf(LayerPlacement value)
{
    return nameIn(kPlacements, value);
}
std::string_view nameOf(MomentSolver value)
{
    return nameIn(kSolvers, value);
}
std::string_view nameOf(LayerAxis value)
{
    return nameIn(kAxes, value);
}
std::string_view nameOf(MomentPenumbra value)
{
    return nameIn(kPenumbrae, value);
}

bool followsLight(Filter filter, const MomentOptions& options)
{
    return (filter == Filter::vsm || filter == Filter::msm) && options.penumbra == MomentPenumbra::light;
}

bool followsDepths(LayerPlacement placement)
{
    return placement == LayerPlacement::lloyd || placement == LayerPlacement::gaps;
}

bool hasWorldLayers(Filter filter, const MomentOptions& options)
{
    return filter == Filter::lvsm && options.placement == LayerPlacement::world;
}

std::optional<std::string> refusal(std::span<const WorldLayer> layers)
{
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const WorldLayer& layer = layers[i];
        if (!(layer.low_m < layer.high_m) || !(layer.low_m >= -kFarthestLayer_m && layer.high_m <= kFarthestLayer_m)) {
            return "a layer of the world has two numbers: its lower end and a higher one, both within 1000 km of the "
                   "world's zero";
        }
        if (i > 0 && !(layers[i - 1].low_m < layer.low_m && layers[i - 1].high_m < layer.high_m)) {
            return "layers of the world go from low to high, both ends of each above those of the one before";
        }
    }
    return std::nullopt;
}

BlurKind blurOf(const MomentOptions& options)
{
    if (options.blur != BlurKind::automatic) {
        return options.blur;
    }
    return options.penumbra == MomentPenumbra::light ? BlurKind::none : BlurKind::gaussian;
}

std::uint32_t blurRadius(const MomentOptions& options)
{
    const BlurKind blur = blurOf(options);
    if (blur == BlurKind::none) {
        return 0;
    }
    if (options.blur_radius_texels > 0) {
        return options.blur_radius_texels;
    }
    if (blur == BlurKind::box) {
        return 2;
    }
    const float three_sigma = std::ceil(3.0F * options.blur_sigma_texels);
    if (!(three_sigma > 1.0F)) { // no number either
        return 1;
    }
    return static_cast<std::uint32_t>(std::min(three_sigma, static_cast<float>(kMaxBlurRadius)));
}

std::uint32_t imageLayersPerMap(Filter filter, const MomentOptions& options)
{
    return filter == Filter::lvsm ? (options.layers + 1) / 2 : 1;
}

double largestExponent(Filter filter, MapFormat format, const MomentOptions& options)
{
    if (options.log_space) {
        return std::numeric_limits<double>::infinity();
    }
    // ln 65504 = 11.09, ln 3.4e38 = 88.7, less a little room for sums. EVSM stores squares: half of it (Lauritzen &
    // McCool 2008 give 5.54 and 42).
    if (filter == Filter::esm) {
        return isHalf(format) ? 11.0 : 88.0;
    }
    return isHalf(format) ? 5.54 : 42.0;
}

double defaultExponent(Filter filter, MapFormat format, const MomentOptions& options, bool negative)
{
    // One warp alone lets light through before the farthest texels of a kernel, the more the larger it is; the second
    // one covers that. Held against the truth on rts, canopies and a city, 5 beat 10 and 40 in two channels.
    const bool one_warp = format == MapFormat::rg32f || format == MapFormat::rg16f;
    const double wish = filter == Filter::esm ? 80.0 : negative || one_warp ? 5.0 : 40.0;
    return std::min(wish, largestExponent(filter, format, options));
}

std::optional<std::string> refusal(Filter filter, MapFormat format, const MomentOptions& options)
{
    if (const auto reason = refusal(filter, format)) {
        return std::string(*reason);
    }
    const FilterTraits* traits = filterTraits(filter);
    if (traits == nullptr || !traits->filterable) {
        return std::nullopt;
    }
    if (options.remap && isUnorm(format) && filter != Filter::msm) { // which has it in any case
        return std::string(nameOf(format)) + " holds 0 to 1 only, so depth cannot be remapped to -1 to 1; floats can";
    }
    if (followsLight(filter, options) && options.metric == DepthMetricKind::z_over_w) {
        return "penumbra light takes the distance to an occluder from depths along the light: depth-metric linear";
    }
    ShadowOptions checked;
    checked.moments = options;
    if (auto reason = firstOutOfRange(checked)) {
        return reason;
    }
    const double largest = largestExponent(filter, format, options);
    switch (filter) {
    case Filter::lvsm:
        if (auto reason = worldRefusal(options)) {
            return reason;
        }
        return splitRefusal(options);
    case Filter::esm:
        return exponentRefusal("exponent", options.esm_exponent, format, largest);
    case Filter::evsm:
        if (auto reason = exponentRefusal("positive exponent", options.evsm_positive, format, largest)) {
            return reason;
        }
        return hasFourChannels(format) ? exponentRefusal("negative exponent", options.evsm_negative, format, largest)
                                       : std::nullopt;
    default:
        return std::nullopt;
    }
}

} // namespace gnomon
