// SPDX-License-Identifier: Apache-2.0
// Turns a light's options into the numbers that its maps are made and read with. Options that were left open are filled
// in here.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <gnomon/shared/filter_pass.h>
#include <gnomon/shared/gpu_structs.h>
#include <gnomon/shared/moment_rule.h>
#include <gnomon/shared/object_ids.h>

#include <cstdint>
#include <span>

namespace gnomon::pack {

/// Bound on the error of a depth that such a map stores, in units of ViewProjection::metric: storage and the single
/// precision that led to it. The automatic bias takes it into account.
[[nodiscard]] GNOMON_API float depthQuantum(MapFormat format);
/// How a texel of a map holds depths: a kDepth constant of gnomon/shared/paired_depth.h. It is kDepthAlone for a
/// filterable map.
[[nodiscard]] GNOMON_API int depthHolding(const ResolvedOptions& options);
/// The rule for gnomon/lib/encoders.glsl and the filters that read those texels. Precondition: options.filterable().
[[nodiscard]] GNOMON_API shared::MomentRule momentRuleOf(const ResolvedOptions& options);
/// The rule for reading maps: momentRuleOf() for filterable filters; for filters that compare depths only the
/// DepthMetricKind of their maps is set.
[[nodiscard]] GNOMON_API shared::MomentRule readingRuleOf(const ResolvedOptions& options);
/// The filter that reads these maps: pcf beside smoothies, else the options' own.
[[nodiscard]] GNOMON_API Filter readingFilter(const ResolvedOptions& options);
/// The rule of filters id and depth-id.
[[nodiscard]] GNOMON_API shared::IdRule idRuleOf(const ResolvedOptions& options);

/// How exactly casters are drawn and receivers are known. The automatic bias covers these errors.
struct DrawPrecision {
    /// Sub-pixel bits with which the device places vertices (VkPhysicalDeviceLimits::subPixelPrecisionBits,
    /// GL_SUBPIXEL_BITS; 8 in Direct3D), 4 to 24; other values are clamped. The default is the least that Vulkan and
    /// OpenGL promise.
    std::uint32_t sub_pixel_bits = 4;
    /// Receivers' points come from a depth buffer that the same device has drawn, or from gl_FragCoord.z; false: a
    /// shading pass interpolates them, or they come from rays.
    bool receivers_from_depth = true;
    /// Half a step of that depth buffer, 0 to 0.01: 2^-17 for 16 bits, 2^-25 for 24 bits and for floats where 1 is far
    /// (Camera::reversed_z false); 0 for floats where 0 is far.
    float depth_rounding = 0x1p-25F;
    /// Bound on the error of receivers' geometric normals, radians, 0 to 0.2: normalError() of their format, or
    /// normalErrorFromDepth().
    float normal_error_rad = 2e-4F;
};

/// The error in radians of normals stored octahedrally (gnomon/shared/octahedral.h) in two numbers of [-1, 1], each off
/// by at most `rounding`: 2^-16 for 16-bit integers, 2^-8 for 8-bit ones, 2^-11 for 16-bit floats, 0 for 32-bit ones.
/// Integers are assumed to be rounded to the nearest, as Direct3D requires; Vulkan leaves the rounding of floats open.
[[nodiscard]] GNOMON_API float normalError(float rounding);
/// The error in radians of normals that are found by differences of a depth buffer.
[[nodiscard]] GNOMON_API float normalErrorFromDepth(std::uint32_t sub_pixel_bits);

/// Fills in all that a filter reads besides the view and the map. GpuRule::disc.zw, one over the size of the maps'
/// image, is left 0: fillConstants() fills it in. Precondition: the members of `precision` are in their ranges.
GNOMON_API void fillRule(const ResolvedOptions& options, const DrawPrecision& precision, shared::GpuRule& out);
/// The weights of a filterable map's blur, normalised in double precision: those of all texels add up to 1.
/// Precondition: blurRadius(options) > 0.
[[nodiscard]] GNOMON_API shared::BlurKernel blurKernel(const MomentOptions& options);

/// Mip levels of maps of this size, 1 to 8: 1 unless the filter is filterable and its sampling reads coarser ones. A
/// coarser texel is an average of four whole ones, so there are as many levels as both sides can be halved without a
/// remainder, and one: an odd side has one level.
[[nodiscard]] GNOMON_API std::uint32_t mipLevels(const ResolvedOptions& options, std::uint32_t width,
                                                 std::uint32_t height);
/// The coarsest mip level whose texels lie in one tile, each over whole texels of the next finer level. `levels`: of
/// the map's image, at least 1.
[[nodiscard]] GNOMON_API std::uint32_t coarsestLevel(const Tile& tile, std::uint32_t levels);
/// Mip levels of the image of blocks beside maps of this size (gnomon/shared/map_blocks.h), at least 1. Filters with
/// FilterTraits::integrates_light (pcss, raymarch) have one: 32-bit unsigned integers, with the maps' layers. A texel
/// of level i is a block of 2^(i + 1) texels on a side.
[[nodiscard]] GNOMON_API std::uint32_t blockLevels(const glm::uvec2& size_px);
/// The size of that image, texels: a square whose side is a power of two, so that each level halves it without a rest.
[[nodiscard]] GNOMON_API glm::uvec2 blocksExtent(const glm::uvec2& size_px);

/// The depth that a texel of a map stands for, to be looked at: in [0, 1] of the map's metric. For a filterable map it
/// is the mean of the averaged depths. For esm and evsm (in the warp of c+) it is the depth whose exponential is the
/// mean of exponentials, and for lvsm the mean in the first layer's own metric. `texel`: the channels of the format, in
/// their order. `part`: the half of a texel that two maps share. A texel that holds no depth gives a number outside of
/// [0, 1], or NaN.
[[nodiscard]] GNOMON_API float mapDepth(const ResolvedOptions& options, std::span<const float> texel,
                                        TexelPart part = TexelPart::whole);

} // namespace gnomon::pack
