// SPDX-License-Identifier: Apache-2.0
// The resolution that a plan's maps deliver to the pixels of a picture, and how much of the maps it uses. It takes
// plain images.
#pragma once

#include "image/image.h"
#include "lab/metrics/error.h"

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>

namespace gnomon::lab {

/// A camera's picture as images of one size that outlive the call.
struct Sight {
    const Camera& camera;
    const ImageF& depth;   // one channel, of the centres of the pixels, as Camera::reversed_z says
    const ImageF& normals; // three channels: geometric, world space, unit; anything at background
};

/// The numbers of TexelDensity as if each surface faced both eye and light: they depend on the distances from the two
/// alone.
struct FacingDensity {
    double p01 = 0.0;
    double p50 = 0.0;
    double p99 = 0.0;
    double one_to_four = 0.0; // share of the pixels with 1 to 4 texels, the range of T. Forsyth (GDC 2006)
};

/// Percentiles over the counted pixels that lie in one of the light's maps; by linear interpolation, as quantile().
struct TexelDensity {
    double p01 = 0.0;
    double p50 = 0.0;
    double p99 = 0.0;
    std::uint64_t counted = 0;
    FacingDensity facing;
    std::uint64_t left_out = 0; // other pixels that see a surface
    ImageF map;                 // shadow texels per screen pixel of each pixel; 0 where left out
};

/// Shadow texels per screen pixel along the texel grid's worse axis, at each counted pixel of `seen`, for the light
/// `light` of `plan`. Zeros when no pixel counts. `reach_texels` (>= 0.5): how far the filter reads, along x and y
/// each; a pixel so near to a tile's edge that it would read beyond it (tileMarginTexels()) is not in that map, because
/// the mask does not read it there. For a sun between two positions (SunSteps) the maps of the stronger one count.
[[nodiscard]] TexelDensity texelDensity(const Sight& seen, const Counted& counted, const Plan& plan,
                                        std::uint32_t light, double reach_texels);

/// How many texels of one light's maps are read. A pixel reads every texel whose centre lies within `reach_texels`
/// (along x and y) of its place in the first view that has it. For a filter over a disc that is the square around the
/// disc. With a sun between two positions (SunSteps) a pixel reads the maps of both, except that outside a band, or by
/// turns, it reads those of one.
struct TexelUse {
    std::uint64_t read = 0; // by one counted pixel at least
    std::uint64_t held = 0; // by the tiles of the light
};
[[nodiscard]] TexelUse texelUse(const Sight& seen, const Counted& counted, const Plan& plan, std::uint32_t light,
                                double reach_texels);
/// Read texels divided by held ones; [0, 1], 0 when the light has no map.
[[nodiscard]] double fitEfficiency(const TexelUse& use);

/// 1 where a pixel's geometric surface faces the light with N·L > kFacing. It needs no truth, so benches can use it.
inline constexpr double kFacing = 0.05; // below it light all but grazes, and large errors cannot be seen
[[nodiscard]] Counted facingPixels(const Sight& seen, const Light& light);
/// 1 where the pixel sees a surface within the light's range and cone, whichever way it faces.
[[nodiscard]] Counted reachedPixels(const Sight& seen, const Light& light);

} // namespace gnomon::lab
