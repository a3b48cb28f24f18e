// SPDX-License-Identifier: Apache-2.0
// What stands below the panels of planSvg(): what the lines mean, the maps' numbers, and the atlas.
#pragma once

#include "plan_panel.h"

namespace gnomon::lab {

struct DrawnBelow {
    std::string svg;
    double end_px = 0.0; // where it ends
};
/// From `rect`'s upper edge down; its height is not asked.
[[nodiscard]] DrawnBelow drawTable(const Plan& plan, const PlanScene& scene, std::uint32_t light,
                                   const PixelRect& rect);

} // namespace gnomon::lab
