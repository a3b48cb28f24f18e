// SPDX-License-Identifier: Apache-2.0
// The resolution that a plan's maps deliver to the pixels of a picture, and how much of the maps it uses.
#pragma once

#include "host/renderer.h"
#include "lab/metrics/error.h"

namespace gnomon::lab {

/// Percentiles over the counted pixels that lie in one of the light's maps.
struct TexelDensity {
    double p01 = 0.0;
    double p50 = 0.0;
    double p99 = 0.0;
    std::uint64_t counted = 0;
    std::uint64_t left_out = 0; // other pixels that see a surface
    ImageF map;                 // shadow texels per screen pixel of each pixel; 0 where left out
};

/// Shadow texels per screen pixel along the texel grid's worse axis, at each counted pixel of `picture` (depth and
/// normals read back), for the light `light` of `plan`. Zeros when no pixel counts.
[[nodiscard]] TexelDensity texelDensity(const host::Picture& picture, const Counted& counted, const Camera& camera,
                                        const Plan& plan, std::uint32_t light);

/// Texels that some counted pixel reads, divided by the texels rendered for the light; [0, 1], 0 when it has no map. A
/// pixel reads every texel whose centre lies within `reach_texels` (along x and y) of the place where the pixel is
/// projected: vulkan::filterReachTexels(). Of a disc that is the square around it.
[[nodiscard]] double fitEfficiency(const host::Picture& picture, const Counted& counted, const Camera& camera,
                                   const Plan& plan, std::uint32_t light, double reach_texels);

/// 1 where a pixel's geometric surface faces the light with N·L > kFacing, whatever truth there is; for benches, which
/// have none.
inline constexpr double kFacing = 0.05; // below, a pixel sees the terminator, whose error is shading's
[[nodiscard]] Counted facingPixels(const host::Picture& picture, const Camera& camera, const Light& light);

} // namespace gnomon::lab
