// SPDX-License-Identifier: Apache-2.0
// The maps of a light that the mask of a plan reads for each pixel of a picture, and the share of each. It takes plain
// images.
#pragma once

#include "lab/score/texel_density.h"

namespace gnomon::lab {

/// The share of each view of the light `light` of `plan` at each pixel: as many channels as the light has views (one,
/// of zeros, where it has no map), which add up to 1 where a view serves the pixel; else all are 0. Between two slices
/// the one fades over into the other; both positions of a sun that steps have their shares of SunSteps. `reach_texels`
/// is as in texelDensity().
[[nodiscard]] ImageF viewShares(const Sight& seen, const Plan& plan, std::uint32_t light, double reach_texels);

} // namespace gnomon::lab
