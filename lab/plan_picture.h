// SPDX-License-Identifier: Apache-2.0
// A light's maps as SVG text, drawn from what a plan and its objects say and nothing else.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <string>

namespace gnomon::lab {

struct PlanCaption {
    std::string title;    // whose maps, of which scene and technique; any bytes, escaped
    std::string subtitle; // what else is to be known
};

/// The maps of the light `light` of `plan`, which was made of `frame`. A panel shows the plane across the light's rays
/// as the light sees it, turned so that the camera looks up: each map's edge with lines at every eighth of it, which
/// shows how a fit warps it; what the camera sees and the light reaches, slice by slice; the boxes of casters, drawn
/// and culled, and of receivers seen; and the camera's line of sight. Further panels show the same in each map (of nine
/// at most); below them stand a table of the maps and the atlas's tiles. Of a stepping sun with two positions the
/// earlier one's maps are shown. Of a point light the first panel shows the scene from above, and of each map the
/// pyramid of what it may hold. Where the light has no map, the reason stands in the picture.
///
/// Self-contained, 1180 px wide, on a dark ground of its own. The same input gives the same bytes. Precondition:
/// light < plan.lights.size(), frame.objects not null.
[[nodiscard]] std::string planSvg(const Frame& frame, const Plan& plan, std::uint32_t light,
                                  const PlanCaption& caption);

} // namespace gnomon::lab
