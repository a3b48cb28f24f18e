// SPDX-License-Identifier: Apache-2.0
// What clip planes leave of polygons and boxes.
#pragma once

#include "scene/model.h"

#include <array>
#include <cstddef>

namespace gnomon::scene {

/// Convex. With four corners at first there is room for what both planes add.
struct Polygon {
    std::array<glm::dvec3, 6> corners{};
    std::size_t count = 0;

    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

/// What `planes` leave of a polygon of at most four corners; empty where that is nothing.
[[nodiscard]] Polygon clipped(const Polygon& polygon, const ClipPlanes& planes);
/// The smallest box around what they leave of `box`; empty where that is nothing. A box that is not finite comes back
/// as it is.
[[nodiscard]] Aabb clipped(const Aabb& box, const ClipPlanes& planes);

} // namespace gnomon::scene
