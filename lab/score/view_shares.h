// SPDX-License-Identifier: Apache-2.0
// Which of a light's maps the mask of a plan reads for each pixel of a picture, and what each counts for. From plain
// images, whoever drew them.
#pragma once

#include "lab/score/texel_density.h"

namespace gnomon::lab {

/// How much each view of the light `light` of `plan` counts for at each pixel: as many channels as the light has views
/// (one, of zeros, where it has no map), which add up to 1 where a view serves the pixel; else all are 0. Between two
/// slices the one fades over into the other; of a sun that steps, both positions count for what SunSteps says.
/// `reach_texels` as texelDensity() has it.
[[nodiscard]] ImageF viewShares(const Sight& seen, const Plan& plan, std::uint32_t light, double reach_texels);

} // namespace gnomon::lab
