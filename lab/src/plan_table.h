// SPDX-License-Identifier: Apache-2.0
// The part of planSvg() below the panels: the meaning of the lines, the maps' numbers, and the atlas.
#pragma once

#include "plan_panel.h"

namespace gnomon::lab {

struct DrawnBelow {
    std::string svg;
    double end_px = 0.0; // where it ends
};
/// Draws from `rect`'s upper edge down, and ignores its height.
[[nodiscard]] DrawnBelow drawTable(const Plan& plan, const PlanScene& scene, std::uint32_t light,
                                   const PixelRect& rect);

} // namespace gnomon::lab
