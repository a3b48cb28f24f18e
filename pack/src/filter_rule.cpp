// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/filter_rule.h>

#include <gnomon/shared/bias.h>
#include <gnomon/shared/discs.h>
#include <gnomon/shared/moments.h>
#include <gnomon/shared/moments_four.h>
#include <gnomon/shared/octahedral.h>
#include <gnomon/shared/paired_depth.h>
#include <gnomon/shared/pcf_weights.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include <gnomon/object_ids.h>

namespace gnomon::pack {
namespace {

constexpr std::uint32_t kMostLevels = 8; // a footprint of 128 texels: what is larger is a texel of the coarsest level

/// Spacing of the format's numbers just below 1.
float stepBelowOne(MapFormat format)
{
    switch (format) {
    case MapFormat::rg16:
    case MapFormat::rgba16:
        return 1.0F / 65535.0F;
    case MapFormat::r16f:
    case MapFormat::rg16f:
    case MapFormat::rgba16f:
        return 1.0F / 2048.0F;
    default:
        return 1.0F / 16777216.0F;
    }
}

/// Hides the effect of the format's rounding on M2 - M1^2, see gnomon/shared/moments.h: as a least variance of d'
/// (lvsm: of a layer's own metric), for evsm as shares of each warp's stored value.
void hideRounding(const ResolvedOptions& options, shared::MomentRule& rule)
{
    const float step = stepBelowOne(options.format());
    if (options.filter() != Filter::evsm) {
        const float scale = shared::momentScale(rule.flags);
        rule.min_variance = shared::varianceOfRounding(step) / (scale * scale);
        return;
    }
    const auto share = [&](float c) {
        const bool logarithms = shared::hasFlag(rule.flags, shared::kMomentLogSpace);
        // All of it at most: an exponent that is so large loses every digit.
        return std::min(logarithms ? shared::shareOfLogRounding(step, c) : shared::shareOfWarpRounding(step), 1.0F);
    };
    rule.rounding = share(rule.exponent);
    rule.rounding_negative = share(rule.exponent_negative);
}

/// Standard deviation along one axis, texels: never more than that of a box of the same radius.
float blurDeviation(const MomentOptions& options)
{
    const auto radius = static_cast<float>(blurRadius(options));
    const float of_box = std::sqrt(radius * (radius + 1.0F) / 3.0F);
    return blurOf(options) == BlurKind::gaussian ? std::min(options.blur_sigma_texels, of_box) : of_box;
}

int flagsOf(const ResolvedOptions& options)
{
    const MomentOptions& o = options.moments();
    int flags = 0;
    const auto set = [&](bool on, int flag) {
        flags |= on ? flag : 0;
    };
    // The basis of quantised moments is made for [-1, 1], and four moments keep more digits there.
    set(o.remap || options.filter() == Filter::msm, shared::kMomentRemap);
    set(options.metric() == DepthMetricKind::z_over_w, shared::kMomentZOverW);
    set(o.log_space && (options.filter() == Filter::esm || options.filter() == Filter::evsm), shared::kMomentLogSpace);
    set(options.format() == MapFormat::rgba16f || options.format() == MapFormat::rgba32f, shared::kMomentFourChannels);
    set(o.solver == MomentSolver::hausdorff, shared::kMomentHausdorff);
    set(options.filter() == Filter::msm && options.format() == MapFormat::rgba16, shared::kMomentQuantised);
    set(o.derivative_variance, shared::kMomentDerivatives);
    set(followsLight(options.filter(), o), shared::kMomentPenumbra);
    return flags;
}

/// How far away what a filter compares a receiver with typically is, for the bias. Averages are compared with the
/// receiver alone: on a plane they are the plane's depth there, however far the kernel reaches, so what its ends may be
/// off does not matter; where a surface bends, an average is off as a texel at the kernel's root mean square distance
/// is.
float biasReachTexels(const ResolvedOptions& options)
{
    if (!options.filterable()) {
        return options.reach_texels();
    }
    const MomentOptions& o = options.moments();
    const auto radius = static_cast<float>(blurRadius(o));
    const float of_blur = blurOf(o) == BlurKind::gaussian ? std::min(o.blur_sigma_texels, radius) : radius * 0.57735F;
    constexpr float kOfBilinear = 0.5F;
    constexpr float kOfRing = 3.0F; // esm also compares single reads that far off (gnomon/lib/esm.glsl)
    return std::max(of_blur + kOfBilinear, options.filter() == Filter::esm ? kOfRing : 0.0F);
}

float smoothiesReach(const ResolvedOptions& options)
{
    return options.hasSmoothies() ? static_cast<float>(options.asked().smoothies.reach_texels) : 0.0F;
}

void lighten(const ResolvedOptions& options, shared::MomentRule& rule)
{
    rule.lighten = options.asked().lighten;
    rule.lighten_cut = options.asked().lighten_as == LightenAs::remap ? rule.lighten : 0.0F;
}

/// In pixels, by the bits that a device says it has.
float snapOfBits(std::uint32_t bits)
{
    return shared::snapOf(static_cast<float>(std::clamp(bits, 4U, 24U)));
}

} // namespace

/// Only the metric counts for filters that compare depths.
shared::MomentRule readingRuleOf(const ResolvedOptions& options)
{
    shared::MomentRule rule = options.filterable() ? momentRuleOf(options) : shared::MomentRule{};
    if (!options.filterable() && options.metric() == DepthMetricKind::z_over_w) {
        rule.flags = shared::kMomentZOverW;
    }
    return rule;
}

shared::IdRule idRuleOf(const ResolvedOptions& options)
{
    constexpr float kStepsOfFloats = 8388608.0F;
    shared::IdRule rule{};
    rule.test = static_cast<float>(options.idTest());
    rule.ids = static_cast<float>(idsOf(options.format()));
    rule.order = idSharingOf(options.filter(), options.ids().of) == IdSharing::neighbours ? 1.0F : 0.0F;
    rule.bias = options.ids().bias.value_or(-1.0F);
    rule.steps = options.format() == MapFormat::rg32f ? kStepsOfFloats : rule.ids;
    if (options.ids().depth == IdDepth::global) {
        rule.steps = -rule.steps;
    }
    return rule;
}

namespace {

void fillMoments(const ResolvedOptions& options, shared::GpuRule& out)
{
    shared::MomentRule rule = readingRuleOf(options);
    lighten(options, rule);
    out.moment_warp = {rule.exponent, rule.exponent_negative, rule.moment_bias, rule.anisotropy};
    out.moment_variance = {rule.min_variance, rule.min_variance_texels, rule.rounding,
                           options.hasSmoothies() ? smoothiesReach(options) : rule.rounding_negative};
    out.moment_shape = {rule.linstep, rule.power, rule.lighten, rule.lighten_cut};
    out.moments = {rule.flags, rule.sampling, rule.layers, 0};
}

} // namespace

float depthQuantum(MapFormat format)
{
    // Single precision carries about 4e-6 through matrix, interpolation and comparison; 16 bits add one step and a
    // half.
    constexpr float kArithmetic = 4e-6F;
    switch (format) {
    case MapFormat::d16:
    case MapFormat::rg16:
    case MapFormat::rgba16:
    case MapFormat::rgba8:
        return 1.5F / 65535.0F + kArithmetic;
    case MapFormat::rg8:
        return 1.5F / 255.0F + kArithmetic;
    case MapFormat::r16f:
    case MapFormat::rg16f:
    case MapFormat::rgba16f:
        return 1.0F / 2048.0F;
    default:
        return kArithmetic;
    }
}

int depthHolding(const ResolvedOptions& options)
{
    if (options.filterable()) {
        return shared::kDepthAlone;
    }
    if (options.hasSmoothies()) {
        return shared::kDepthSmoothies;
    }
    if (options.traits().ids) { // the id, and beside it a depth
        return options.filter() == Filter::depth_id ? shared::kDepthChannel : shared::kDepthAlone;
    }
    const MapFormat format = options.format();
    return format == MapFormat::rg16 || format == MapFormat::rg16f ? shared::kDepthChannel
           : format == MapFormat::rgba8                            ? shared::kDepthBytes
                                                                   : shared::kDepthAlone;
}

shared::MomentRule momentRuleOf(const ResolvedOptions& options)
{
    const MomentOptions& o = options.moments();
    shared::MomentRule rule{};
    rule.flags = flagsOf(options);
    // Options speak of exponents of d', shaders of those of the coordinate that is stored: from -1 to 1 it spans e^(-c
    // / 2) to e^(c / 2), which any format that holds 1 to e^c holds, too.
    const auto exponent = [&](const std::optional<float>& wish, bool negative) {
        return wish.value_or(static_cast<float>(defaultExponent(options.filter(), options.format(), o, negative))) /
               shared::momentScale(rule.flags);
    };
    rule.sampling = static_cast<int>(o.sampling);
    rule.layers = static_cast<int>(o.layers);
    rule.exponent = exponent(options.filter() == Filter::esm ? o.esm_exponent : o.evsm_positive, false);
    rule.exponent_negative = exponent(o.evsm_negative, true);
    // The least that keeps slanted planes lit whose moments were rounded at the first write and by the blur, alone and
    // below a little of an occluder, found by experiment (tests/shaders/msm_test.cpp). With 32 bits a tenth of that
    // would be enough, but the bounds' own arithmetic, in single precision, is then off by up to a fifth: at 3e-6 it
    // stays
    // within a step of the mask in 99.9 % of distributions (tests/shaders/single_precision_float_test.cpp).
    rule.moment_bias = o.moment_bias.value_or(options.format() == MapFormat::rgba16 ? 4e-5F : 3e-6F);
    if (options.filter() == Filter::msm) {
        rule.min_variance_texels = blurDeviation(o);
    } else if (o.min_variance) {
        rule.min_variance = *o.min_variance;
    } else {
        rule.min_variance_texels = 0.5F;
        hideRounding(options, rule);
    }
    rule.linstep = o.bleeding_linstep;
    rule.power = o.bleeding_power;
    lighten(options, rule);
    rule.anisotropy = static_cast<float>(o.anisotropy);
    return rule;
}

float normalError(float rounding)
{
    return shared::kNormalArithmetic + shared::kOctahedralStretch * rounding;
}

float normalErrorFromDepth(std::uint32_t sub_pixel_bits)
{
    return normalError(0.0F) + snapOfBits(sub_pixel_bits);
}

Filter readingFilter(const ResolvedOptions& options)
{
    return options.hasFins() ? Filter::pcf : options.filter();
}

void fillRule(const ResolvedOptions& options, const DrawPrecision& precision, shared::GpuRule& out)
{
    assert(precision.normal_error_rad >= 0.0F && precision.normal_error_rad <= 0.2F &&
           precision.depth_rounding >= 0.0F && precision.depth_rounding <= 0.01F);
    const BiasOptions& bias = options.bias();
    const PcfOptions& pcf = options.pcf();
    const float snap = snapOfBits(precision.sub_pixel_bits);
    out.bias = bias.automatic
                   ? glm::vec4(1.0F, snap, precision.receivers_from_depth ? snap : 0.0F, precision.normal_error_rad)
                   : glm::vec4(0.0F, bias.constant_m, bias.slope, bias.normal_texels);
    const float rounding = precision.receivers_from_depth ? precision.depth_rounding : 0.0F;
    out.bias_more = {bias.automatic        ? rounding
                     : bias.receiver_plane ? 1.0F
                                           : 0.0F,
                     biasReachTexels(options), depthQuantum(options.format()),
                     options.traits().integrates_light ? 1.0F : 0.0F};
    out.kernel = shared::gaussianWeights(std::max(kernelWidth(pcf.kernel), 1), pcf.sigma_texels.value_or(0.0F));
    if (options.traits().ids) {
        const shared::IdRule ids = idRuleOf(options);
        out.kernel = {ids.test, ids.order > 0.0F ? -ids.ids : ids.ids, ids.bias, ids.steps};
        out.bias_more.z = ids.steps < 0.0F ? depthQuantum(options.format()) : depthQuantum(MapFormat::d32f);
    }
    out.disc = {pcf.radius_texels, 0.0F, 0.0F, 0.0F};
    const auto taps = static_cast<int>(pcf.taps);
    for (int i = 0; i < taps; ++i) {
        const glm::vec2 point =
            pcf.kernel == PcfKernel::poisson ? shared::kPoissonPoints[i] : shared::vogelPoint(i, taps);
        glm::vec4& two = out.disc_points[i / 2];
        (i % 2 == 0 ? two.x : two.z) = point.x;
        (i % 2 == 0 ? two.y : two.w) = point.y;
    }
    fillMoments(options, out);
    out.reading = {static_cast<int>(readingFilter(options)), kernelWidth(pcf.kernel), taps, depthHolding(options)};
}

float mapDepth(const ResolvedOptions& options, std::span<const float> texel, TexelPart part)
{
    assert(!texel.empty());
    float t = texel[0];
    if (options.traits().ids) { // the depth is beside the id
        return texel.size() > 1 ? texel[1] : t;
    }
    if (!options.filterable()) {
        glm::vec4 channels(t);
        for (std::size_t i = 0; i < std::min<std::size_t>(texel.size(), 4); ++i) {
            channels[static_cast<int>(i)] = texel[i];
        }
        return shared::pairedDepth(depthHolding(options), channels, part == TexelPart::second ? 1.0F : 0.0F);
    }
    const shared::MomentRule rule = momentRuleOf(options);
    const bool warped = options.filter() == Filter::esm || options.filter() == Filter::evsm;
    if (warped && !shared::hasFlag(rule.flags, shared::kMomentLogSpace)) {
        t = std::log(t) / rule.exponent;
    } else if (shared::hasFlag(rule.flags, shared::kMomentQuantised)) {
        assert(texel.size() == 4);
        t = shared::momentsOfQuantised({texel[0], texel[1], texel[2], texel[3]}).x;
    }
    return shared::hasFlag(rule.flags, shared::kMomentRemap) ? 0.5F * (t + 1.0F) : t;
}

std::uint32_t mipLevels(const ResolvedOptions& options, std::uint32_t width, std::uint32_t height)
{
    const MapSampling sampling = options.moments().sampling;
    if (!options.filterable() || sampling == MapSampling::nearest || sampling == MapSampling::bilinear) {
        return 1;
    }
    // As coarsestLevel(): a texel of a coarser level is an average of whole texels of the next finer one.
    const auto halvings = static_cast<std::uint32_t>(std::countr_zero(width | height));
    return std::min(halvings + 1, kMostLevels);
}

std::uint32_t blockLevels(const glm::uvec2& size_px)
{
    const std::uint32_t side = std::max({size_px.x, size_px.y, 2U});
    return static_cast<std::uint32_t>(std::bit_width(side - 1));
}

glm::uvec2 blocksExtent(const glm::uvec2& size_px)
{
    return glm::uvec2(1U << (blockLevels(size_px) - 1));
}

std::uint32_t coarsestLevel(const Tile& tile, std::uint32_t levels)
{
    const std::uint32_t edges = tile.x | tile.y | tile.width | tile.height;
    return std::min(static_cast<std::uint32_t>(std::countr_zero(edges)), levels - 1);
}

} // namespace gnomon::pack
