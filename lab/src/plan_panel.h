// SPDX-License-Identifier: Apache-2.0
// The panels of planSvg(): the plane across a light, and its maps.
#pragma once

#include "plan_shapes.h"

#include <cstdint>
#include <string>

namespace gnomon::lab {

struct PixelRect {
    double x = 0.0;
    double y = 0.0;
    double width = 0.0;
    double height = 0.0;
};

struct PlanObject {
    bool casts = false;
    bool drawn = false; // in one of the maps
    bool seen = false;  // by the camera, and receives
};
/// A scene in a plane.
struct PlanLook {
    LightPlane plane;
    std::vector<Polygon> shapes;   // shapes of objects, by index
    std::optional<glm::dvec2> eye; // nothing: behind the light
    Polygon sight;                 // points of the camera's line of sight, from the eye on; open
};
struct PlanMap {
    std::uint32_t view = 0; // index into Plan::views
    PlanLook look;          // across its axis
    glm::dmat3 from_plane{1.0};
    Polygon seen;
    Polygon seen_across;    // the same in the plane of PlanScene::across
    Polygon outline_across; // the outline of the part that the map covers, there
    std::vector<std::uint32_t> casters;
};
/// All that is drawn.
struct PlanScene {
    PlanLook across; // a point light seen from above
    bool from_above = false;
    std::vector<PlanObject> objects; // by index
    std::vector<PlanMap> maps;
};

/// Precondition of both: a map at least.
[[nodiscard]] std::string drawAcross(const PlanScene& scene, const PixelRect& rect);
[[nodiscard]] std::string drawInMap(const PlanScene& scene, std::size_t map, const PixelRect& rect);

/// "#rrggbb" of map i.
[[nodiscard]] std::string mapColour(std::size_t i);

} // namespace gnomon::lab
