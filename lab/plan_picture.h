// SPDX-License-Identifier: Apache-2.0
// A light's maps as SVG text, drawn from a plan and its objects alone.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <string>

namespace gnomon::lab {

struct PlanCaption {
    std::string title;    // whose maps, of which scene and technique; any bytes, escaped
    std::string subtitle; // further facts
};

/// The maps of the light `light` of `plan`, which was made of `frame`. A panel shows the plane across the light's rays
/// as the light sees it, turned so that the camera looks up: each map's edge with lines at every eighth of it, which
/// shows how a fit warps it; what the camera sees and the light reaches, slice by slice; the boxes of casters, drawn
/// and culled, and of receivers seen; and the camera's line of sight. Further panels show the same in each map, nine at
/// most; below them stand a table of the maps and the atlas's tiles. A stepping sun with two positions shows the maps
/// of the earlier one. For a point light the first panel shows the scene from above, with each map's pyramid. Where the
/// light has no map, the picture says why.
///
/// Self-contained, 1180 px wide, on a dark ground of its own. The same input gives the same bytes. Precondition:
/// light < plan.lights.size(), frame.objects not null.
[[nodiscard]] std::string planSvg(const Frame& frame, const Plan& plan, std::uint32_t light,
                                  const PlanCaption& caption);

} // namespace gnomon::lab
