// SPDX-License-Identifier: Apache-2.0
// Based on: C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5 (closest point on a triangle).
#include "shot_parts.h"

#include "scene/clip.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon::app {
namespace {

/// The square of the distance from the origin to the segment from `a` to `b`, which may be a point.
double distance2ToSegment(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(-glm::dot(a, along) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 nearest = a + along * t;
    return glm::dot(nearest, nearest);
}

/// The square of the distance from the origin to a triangle, which may be a line or a point. Departure from the source:
/// inside or outside is told by the three edge planes, and outside the nearest of the three edges counts.
double distance2ToTriangle(const std::array<glm::dvec3, 3>& corners)
{
    const auto& [a, b, c] = corners;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length2 = glm::dot(normal, normal);
    const bool inside = length2 > 0.0 && glm::dot(glm::cross(a, b), normal) >= 0.0 &&
                        glm::dot(glm::cross(b, c), normal) >= 0.0 && glm::dot(glm::cross(c, a), normal) >= 0.0;
    if (inside) {
        const double height = glm::dot(a, normal);
        return height * height / length2;
    }
    return std::min({distance2ToSegment(a, b), distance2ToSegment(b, c), distance2ToSegment(c, a)});
}

/// The squared distance from the origin to the polygon transformed by `rel_from_object`.
double distance2ToPolygon(const scene::Polygon& polygon, const glm::dmat4& rel_from_object)
{
    const auto corner = [&](std::size_t i) {
        return glm::dvec3(rel_from_object * glm::dvec4(polygon.corners[i], 1.0));
    };
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 2; i < polygon.count; ++i) {
        least = std::min(least, distance2ToTriangle({corner(0), corner(i - 1), corner(i)}));
    }
    return least;
}

bool meetsBounds(const Aabb& bounds_ws, const glm::dvec3& centre_ws, double radius2)
{
    const glm::dvec3 to = glm::clamp(centre_ws, glm::dvec3(bounds_ws.min), glm::dvec3(bounds_ws.max)) - centre_ws;
    return !bounds_ws.empty() && glm::dot(to, to) < radius2;
}

} // namespace

bool holdsSurface(const scene::Scene& scene, const scene::State& state, const glm::dvec3& centre_ws, double radius_m)
{
    const double radius2 = radius_m * radius_m;
    for (const scene::Object& object : state.objects) {
        const bool blended = object.material < scene.materials.size() &&
                             scene.materials[object.material].alpha_mode == scene::AlphaMode::blend;
        if (blended || !meetsBounds(object.bounds_ws, centre_ws, radius2)) {
            continue;
        }
        const scene::Primitive& primitive = scene.meshes[object.mesh].primitives[object.primitive];
        const std::vector<glm::vec3>& positions =
            object.deformed == scene::kNone ? primitive.positions : state.deformed[object.deformed].positions;
        glm::dmat4 rel_from_object(object.world_from_object);
        rel_from_object[3] -= glm::dvec4(centre_ws, 0.0);
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            scene::Polygon triangle;
            for (std::size_t k = 0; k < 3; ++k) {
                triangle.add(glm::dvec3(positions[primitive.indices[i + k]]));
            }
            if (distance2ToPolygon(scene::clipped(triangle, object.clip_planes), rel_from_object) < radius2) {
                return true;
            }
        }
    }
    return false;
}

} // namespace gnomon::app
