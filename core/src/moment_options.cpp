// SPDX-License-Identifier: Apache-2.0
#include <gnomon/moment_options.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

bool isHalf(MapFormat format)
{
    return format == MapFormat::r16f || format == MapFormat::rg16f || format == MapFormat::rgba16f;
}
bool isUnorm(MapFormat format)
{
    return format == MapFormat::rg16 || format == MapFormat::rgba16;
}

std::string outside(std::string_view name, double value, std::string_view range)
{
    std::string text(name);
    return text + " " + std::to_string(value) + " is outside " + std::string(range);
}

std::optional<std::string> exponentRefusal(std::string_view name, const std::optional<float>& wish, double largest)
{
    if (!wish) {
        return std::nullopt;
    }
    if (!(*wish > 0.0F)) {
        return std::string(name) + " must be more than 0";
    }
    if (static_cast<double>(*wish) > largest) {
        return std::string(name) + " " + std::to_string(*wish) + " would overflow: this format holds up to " +
               std::to_string(largest) + " (in log space there is no such limit)";
    }
    return std::nullopt;
}

std::optional<std::string> layerRefusal(const MomentOptions& o)
{
    if (o.layers < 2 || o.layers > kMaxDepthLayers) {
        return outside("layers", o.layers, "2 .. 8");
    }
    if (!(o.layer_overlap >= 0.0F && o.layer_overlap <= 0.5F)) {
        return outside("layer overlap", static_cast<double>(o.layer_overlap), "0 .. 0.5");
    }
    float last = 0.0F;
    for (std::uint32_t i = 0; o.placement == LayerPlacement::by_hand && i + 1 < o.layers; ++i) {
        if (!(o.splits[i] > last && o.splits[i] < 1.0F)) {
            return "layers placed by hand meet at ascending depths between 0 and 1, one fewer than there are layers";
        }
        last = o.splits[i];
    }
    return std::nullopt;
}

std::optional<std::string> chainRefusal(const MomentOptions& o)
{
    if (o.samples != 1 && o.samples != 4) {
        return outside("samples", o.samples, "1, 4");
    }
    if (!(o.blur_sigma_texels >= 0.3F && o.blur_sigma_texels <= 10.0F)) {
        return outside("blur sigma", static_cast<double>(o.blur_sigma_texels), "0.3 .. 10");
    }
    if (o.blur_radius_texels > kMaxBlurRadius) {
        return outside("blur radius", o.blur_radius_texels, "1 .. 31");
    }
    if (o.anisotropy < 2 || o.anisotropy > 16) {
        return outside("anisotropy", o.anisotropy, "2 .. 16");
    }
    if (o.min_variance && !(*o.min_variance >= 0.0F && *o.min_variance <= 1.0F)) {
        return outside("minimum variance", static_cast<double>(*o.min_variance), "0 .. 1");
    }
    if (!(o.bleeding_linstep >= 0.0F && o.bleeding_linstep <= 0.99F)) {
        return outside("linear step", static_cast<double>(o.bleeding_linstep), "0 .. 0.99");
    }
    if (!(o.bleeding_power >= 0.1F && o.bleeding_power <= 16.0F)) {
        return outside("power", static_cast<double>(o.bleeding_power), "0.1 .. 16");
    }
    if (!(o.lighten >= 0.0F && o.lighten <= 1.0F)) {
        return outside("lighten", static_cast<double>(o.lighten), "0 .. 1");
    }
    if (o.moment_bias && !(*o.moment_bias >= 0.0F && *o.moment_bias <= 0.1F)) {
        return outside("moment bias", static_cast<double>(*o.moment_bias), "0 .. 0.1");
    }
    return std::nullopt;
}

} // namespace

std::string_view nameOf(DepthMetricKind value)
{
    return value == DepthMetricKind::linear ? "linear" : "z-over-w";
}
std::string_view nameOf(BlurKind value)
{
    constexpr std::array<std::string_view, 3> kNames{"none", "gaussian", "box"};
    return kNames[static_cast<std::size_t>(value)];
}
std::string_view nameOf(BlurPath value)
{
    constexpr std::array<std::string_view, 3> kNames{"auto", "compute", "fragment"};
    return kNames[static_cast<std::size_t>(value)];
}
std::string_view nameOf(MapSampling value)
{
    constexpr std::array<std::string_view, 4> kNames{"nearest", "bilinear", "trilinear", "anisotropic"};
    return kNames[static_cast<std::size_t>(value)];
}
std::string_view nameOf(LayerPlacement value)
{
    constexpr std::array<std::string_view, 3> kNames{"uniform", "hand", "lloyd"};
    return kNames[static_cast<std::size_t>(value)];
}
std::string_view nameOf(MomentSolver value)
{
    return value == MomentSolver::hamburger ? "hamburger" : "hausdorff";
}

std::uint32_t blurRadius(const MomentOptions& options)
{
    if (options.blur == BlurKind::none) {
        return 0;
    }
    if (options.blur_radius_texels > 0) {
        return options.blur_radius_texels;
    }
    const auto three_sigma = static_cast<std::uint32_t>(std::ceil(3.0F * options.blur_sigma_texels));
    return options.blur == BlurKind::box ? 2 : std::clamp(three_sigma, 1U, kMaxBlurRadius);
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
    const double wish = filter == Filter::esm ? 80.0 : negative ? 5.0 : 40.0;
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
    if (options.remap && isUnorm(format)) {
        return "a unorm format holds 0 to 1 only, so depth cannot be remapped to [-1, 1]; a float format can";
    }
    if (const auto reason = chainRefusal(options)) {
        return reason;
    }
    const double largest = largestExponent(filter, format, options);
    switch (filter) {
    case Filter::lvsm:
        return layerRefusal(options);
    case Filter::esm:
        return exponentRefusal("the exponent of esm", options.esm_exponent, largest);
    case Filter::evsm:
        if (const auto reason = exponentRefusal("the positive exponent of evsm", options.evsm_positive, largest)) {
            return reason;
        }
        return exponentRefusal("the negative exponent of evsm", options.evsm_negative, largest);
    default:
        return std::nullopt;
    }
}

} // namespace gnomon
