// SPDX-License-Identifier: Apache-2.0
// Based on: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974.
#include "scene/clip.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace gnomon::scene {
namespace {

double distanceOf(const glm::dvec3& p, const glm::vec4& plane)
{
    return glm::dot(glm::dvec3(plane), p) + double{plane.w};
}

/// A plane adds at most one corner.
Polygon cutBy(const glm::vec4& plane, const Polygon& polygon)
{
    Polygon left;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3& a = polygon.corners[i];
        const glm::dvec3& b = polygon.corners[(i + 1) % polygon.count];
        const double of_a = distanceOf(a, plane);
        const double of_b = distanceOf(b, plane);
        if (of_a >= 0.0) {
            left.add(a);
        }
        if ((of_a >= 0.0) != (of_b >= 0.0)) {
            left.add(a + (b - a) * (of_a / (of_a - of_b)));
        }
    }
    return left;
}

Polygon faceOf(const Aabb& box, int axis, bool high)
{
    const int across = 1 << ((axis + 1) % 3);
    const int up = 1 << ((axis + 2) % 3);
    const int first = high ? 1 << axis : 0;
    Polygon face;
    for (const int corner : {first, first + across, first + across + up, first + up}) {
        face.add(glm::dvec3(box.corner(corner)));
    }
    return face;
}

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

Polygon clipped(const Polygon& polygon, const ClipPlanes& planes)
{
    return cutBy(planes[1], cutBy(planes[0], polygon));
}

// Two planes meet in a line, which leaves the box through its faces. So all corners of what is left are on the faces,
// and these are cut instead of the body, which may be flat.
Aabb clipped(const Aabb& box, const ClipPlanes& planes)
{
    if (planes == kNoClipPlanes || box.empty() || !isFinite(box.min) || !isFinite(box.max)) {
        return box;
    }
    Aabb left;
    for (int face = 0; face < 6; ++face) {
        const Polygon polygon = clipped(faceOf(box, face / 2, face % 2 != 0), planes);
        for (std::size_t i = 0; i < polygon.count; ++i) {
            left = merge(left, glm::clamp(glm::vec3(polygon.corners[i]), box.min, box.max));
        }
    }
    return left;
}

} // namespace gnomon::scene
