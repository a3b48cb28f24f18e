// SPDX-License-Identifier: Apache-2.0
// Options of the filterable shadow maps (vsm, lvsm, esm, evsm, msm): what is stored, how it is blurred and read, and
// how visibility is computed from it.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gnomon {

/// The depth that is stored. `z_over_w` is the value in a perspective projection's depth buffer, z' = m / (r + m (1 -
/// r)) with r = near / far; it is there to show why it is worse. Under a parallel light both are the same.
enum class DepthMetricKind : std::uint8_t { linear, z_over_w };
/// Separable kernels; `box` weighs all texels alike. `automatic` is gaussian, and none where penumbrae follow the
/// light, because a blurred map would make them wider.
enum class BlurKind : std::uint8_t { automatic, none, gaussian, box };
/// Which shaders blur. `automatic` is compute: the same frame gives the same bits on every run.
enum class BlurPath : std::uint8_t { automatic, compute, fragment };
/// How the map is read: `trilinear` at the level that the receiver's footprint asks for, `anisotropic` with several
/// such reads along its longer side.
enum class MapSampling : std::uint8_t { nearest, bilinear, trilinear, anisotropic };
/// lvsm: where one layer of depth ends and the next begins.
/// `world`: layers are volumes of the world, each with ends of its own, which no camera moves.
enum class LayerPlacement : std::uint8_t { uniform, by_hand, lloyd, gaps, world };
/// The axis along which layers of the world are measured. `height`: along +y, from the world's zero. `light`: along the
/// light's direction, from the world's zero for a directional light, and from the light's place for others.
enum class LayerAxis : std::uint8_t { height, light };
/// A layer of the world. All zero: none.
struct WorldLayer {
    double low_m = 0.0;  // -1e6 .. 1e6 each; low_m < high_m
    double high_m = 0.0; // where it ends

    bool operator==(const WorldLayer&) const = default;
};
/// msm: which of the paper's two bounds.
enum class MomentSolver : std::uint8_t { hamburger, hausdorff };
/// vsm, msm: how wide shadows' edges are. `fixed`: as the blur; `light`: as the light's size and the depth of occluders
/// make the penumbra.
enum class MomentPenumbra : std::uint8_t { fixed, light };

inline constexpr std::uint32_t kMaxBlurRadius = 31; // texels
inline constexpr std::uint32_t kMaxDepthLayers = 8; // the largest MomentOptions::layers

/// How filterable maps are made and read. A comment before each member names its filters; it has no effect on others.
struct MomentOptions {
    DepthMetricKind metric = DepthMetricKind::linear; // the depth that is stored
    /// Store 2 d' - 1: a float's sign bit is precision too. Refused for unorm formats. Without effect on msm, which
    /// always stores -1 to 1. All other options keep their meaning.
    bool remap = false;
    std::uint32_t samples = 4;                    // samples a texel in the depth pass, 1 or 4; averaged as moments,
                                                  // never as depths
    BlurKind blur = BlurKind::automatic;          // done once for all pixels
    float blur_sigma_texels = 1.25F;              // gaussian; 0.3 .. 10
    std::uint32_t blur_radius_texels = 0;         // 1 .. 31; 0: three sigma rounded up (box: 2)
    BlurPath blur_path = BlurPath::automatic;     // differs only in time and rounding
    MapSampling sampling = MapSampling::bilinear; // bilinear is most exact at rest; coarser levels avoid shimmer
    std::uint32_t anisotropy = 8;                 // anisotropic: most reads a pixel, 2 .. 16

    // vsm, msm
    /// light: refused with metric z_over_w, which gives no distance to an occluder.
    MomentPenumbra penumbra = MomentPenumbra::fixed;
    // vsm, lvsm, evsm
    /// Least variance, in squares of the depth metric (lvsm: of a layer's own depth), 0 .. 1. Nothing: the least that
    /// covers the format's rounding and half a texel of depth on a slope.
    std::optional<float> min_variance;
    bool derivative_variance = false; // adds 1/4 (ddx^2 + ddy^2) of depth to the second moment
    // all
    float bleeding_linstep = 0.0F; // visibility up to this is 0, above it is stretched to [0, 1]; 0 .. 0.99
    float bleeding_power = 1.0F;   // then raised to this; 0.1 .. 16

    // lvsm
    std::uint32_t layers = 2;                        // 2 .. 8, two to a texel
    LayerPlacement placement = LayerPlacement::gaps; // where one layer ends and the next begins
    /// by_hand: where layers meet, ascending, (0, 1), in the depths that the map stores (`metric`); the first layers -
    /// 1 count.
    std::array<float, kMaxDepthLayers - 1> splits{};
    float layer_overlap = 0.05F; // how far a layer reaches into its neighbours, share of its own range; 0 .. 0.5
    /// world: as many as `layers`, from low to high; they may leave room between them, or overlap. All zero: those of
    /// Frame::layers, or where that is empty, layers found in the scene (docs/techniques/lvsm.md).
    std::array<WorldLayer, kMaxDepthLayers> world_layers{};
    LayerAxis layer_axis = LayerAxis::height; // height: refused for a light with a place

    // esm, evsm
    /// Store logarithms, and average the values that they stand for: any exponent fits any format.
    bool log_space = false;
    /// Exponents for depths 0 to 1. 0.01 .. 10000, at most largestExponent(); nothing: defaultExponent().
    std::optional<float> esm_exponent;  // c
    std::optional<float> evsm_positive; // c+
    std::optional<float> evsm_negative; // c-; formats of four channels
    // msm
    MomentSolver solver = MomentSolver::hamburger; // which of the two bounds is taken
    /// How far moments are moved towards those of a known distribution, 0 .. 0.1: hides rounding, and lets a little
    /// light through. Nothing: the least that keeps lit surfaces lit and single precision exact enough: 4e-5 at 16
    /// bits, 3e-6 at 32 bits.
    std::optional<float> moment_bias;

    bool operator==(const MomentOptions&) const = default;
};

[[nodiscard]] GNOMON_API std::string_view nameOf(DepthMetricKind value);
[[nodiscard]] GNOMON_API std::string_view nameOf(BlurKind value);
[[nodiscard]] GNOMON_API std::string_view nameOf(BlurPath value);
[[nodiscard]] GNOMON_API std::string_view nameOf(MapSampling value);
[[nodiscard]] GNOMON_API std::string_view nameOf(LayerPlacement value);
[[nodiscard]] GNOMON_API std::string_view nameOf(LayerAxis value);
[[nodiscard]] GNOMON_API std::string_view nameOf(MomentSolver value);
[[nodiscard]] GNOMON_API std::string_view nameOf(MomentPenumbra value);

/// Does the placement depend on the depths in each map? Then layers are found on the GPU.
[[nodiscard]] GNOMON_API bool followsDepths(LayerPlacement placement);
/// Are the filter's layers of depth volumes of the world?
[[nodiscard]] GNOMON_API bool hasWorldLayers(Filter filter, const MomentOptions& options);
/// Why these layers of the world cannot be had, as a sentence; nothing when they can.
[[nodiscard]] GNOMON_API std::optional<std::string> refusal(std::span<const WorldLayer> layers);
/// Does this filter, with these options, make penumbrae as wide as the light's size asks?
[[nodiscard]] GNOMON_API bool followsLight(Filter filter, const MomentOptions& options);
/// The blur that is done: never automatic.
[[nodiscard]] GNOMON_API BlurKind blurOf(const MomentOptions& options);
/// Texels of the kernel on each side of its middle; 0 without blur.
[[nodiscard]] GNOMON_API std::uint32_t blurRadius(const MomentOptions& options);
/// Image layers of one map of this filter: lvsm has one for each two layers of depth, all others have one.
[[nodiscard]] GNOMON_API std::uint32_t imageLayersPerMap(Filter filter, const MomentOptions& options);
/// The largest exponent whose stored values a format holds: ESM stores e^c, EVSM e^2c; without bound in log space.
[[nodiscard]] GNOMON_API double largestExponent(Filter filter, MapFormat format, const MomentOptions& options);
/// The exponent that is used where none is given: esm 80; evsm 40 and 5, or 5 with two channels; or the format's
/// largest where that is less.
[[nodiscard]] GNOMON_API double defaultExponent(Filter filter, MapFormat format, const MomentOptions& options,
                                                bool negative);
/// Why these options cannot be had together, as a sentence; nothing when they can. Ranges above are checked here too.
[[nodiscard]] GNOMON_API std::optional<std::string> refusal(Filter filter, MapFormat format,
                                                            const MomentOptions& options);

} // namespace gnomon
