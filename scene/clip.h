// SPDX-License-Identifier: Apache-2.0
// Polygons and boxes cut by clip planes.
#pragma once

#include "scene/model.h"

#include <array>
#include <cstddef>

namespace gnomon::scene {

/// Convex. With four corners at first it has room for those that both planes add.
struct Polygon {
    std::array<glm::dvec3, 6> corners{};
    std::size_t count = 0;

    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

/// The part of a polygon of at most four corners that `planes` leave; empty where nothing is left.
[[nodiscard]] Polygon clipped(const Polygon& polygon, const ClipPlanes& planes);
/// The smallest box around the part of `box` that they leave; empty where nothing is left. A box that is not finite is
/// returned unchanged.
[[nodiscard]] Aabb clipped(const Aabb& box, const ClipPlanes& planes);

} // namespace gnomon::scene
