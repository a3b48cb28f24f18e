// SPDX-License-Identifier: Apache-2.0
// The resolution that a plan's maps deliver to the pixels of a picture.
#pragma once

#include "host/renderer.h"

namespace gnomon::app {

/// Percentiles over the pixels whose surface faces the light (N·L > 0.05) and lies in one of its maps.
struct TexelDensity {
    double p01 = 0.0;
    double p50 = 0.0;
    double p99 = 0.0;
    std::uint64_t counted = 0;
    std::uint64_t left_out = 0;
};

/// Shadow texels per screen pixel along the texel grid's worse axis, at each pixel of `picture` (depth and normals read
/// back), for the light `light` of `plan`. Zeros when no pixel counts.
[[nodiscard]] TexelDensity texelDensity(const host::Picture& picture, const Camera& camera, const Plan& plan,
                                        std::span<const Light> lights, std::uint32_t light);

} // namespace gnomon::app
