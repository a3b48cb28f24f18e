// SPDX-License-Identifier: Apache-2.0
// lab/score/texel_density.h for pictures of our host: depth and normals read back.
#pragma once

#include "host/present.h"
#include "host/view.h"
#include "lab/score/texel_density.h"

namespace gnomon::lab {

[[nodiscard]] TexelDensity texelDensity(const host::Picture& picture, const Counted& counted, const Camera& camera,
                                        const Plan& plan, std::uint32_t light, double reach_texels);

/// Texels that some counted pixel reads, divided by the texels held for the light; [0, 1], 0 when it has no map.
/// `reach_texels`: reachTexels().
[[nodiscard]] double fitEfficiency(const host::Picture& picture, const Counted& counted, const Camera& camera,
                                   const Plan& plan, std::uint32_t light, double reach_texels);

[[nodiscard]] Counted facingPixels(const host::Picture& picture, const Camera& camera, const Light& light);

} // namespace gnomon::lab
