// SPDX-License-Identifier: Apache-2.0
// Boxes, frustum planes and the test of one against the other.
// Based on: J. Arvo, "Transforming axis-aligned bounding boxes", Graphics Gems, 1990; G. Gribb, K. Hartmann, "Fast
// extraction of viewing frustum planes from the world-view-projection matrix", 2001.
#include <gnomon/geometry.h>

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>

namespace gnomon {

Aabb merge(const Aabb& a, const Aabb& b)
{
    if (a.empty()) {
        return b;
    }
    if (b.empty()) {
        return a;
    }
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

Aabb merge(const Aabb& a, const glm::vec3& point)
{
    if (a.empty()) {
        return {point, point};
    }
    return {glm::min(a.min, point), glm::max(a.max, point)};
}

Aabb transform(const glm::mat4& b_from_a, const Aabb& box_a)
{
    if (box_a.empty()) {
        return {};
    }
    Aabb box_b{glm::vec3(b_from_a[3]), glm::vec3(b_from_a[3])};
    for (int column = 0; column < 3; ++column) {
        const glm::vec3 at_min = glm::vec3(b_from_a[column]) * box_a.min[column];
        const glm::vec3 at_max = glm::vec3(b_from_a[column]) * box_a.max[column];
        box_b.min += glm::min(at_min, at_max);
        box_b.max += glm::max(at_min, at_max);
    }
    return box_b;
}

namespace {

/// `row` as a plane. `size` is the length of the normals that it was made from: what is left of them after they cancel
/// is rounding, and the plane is at infinity.
Plane planeFromRow(const glm::dvec4& row, double size)
{
    constexpr double kRounding = 1e-13;
    const glm::dvec3 normal(row);
    const double length = glm::length(normal);
    if (!(length > kRounding * size)) {
        return {glm::dvec3(0.0), row.w >= 0.0 ? 1.0 : -1.0};
    }
    return {normal / length, row.w / length};
}

} // namespace

std::array<Plane, 6> planesAround(const glm::dvec3& low, const glm::dvec3& high)
{
    std::array<Plane, 6> planes;
    for (int i = 0; i < 6; ++i) {
        const bool is_low = i % 2 == 0;
        glm::dvec3 normal(0.0);
        normal[i / 2] = is_low ? 1.0 : -1.0;
        planes[static_cast<std::size_t>(i)] = {normal, -glm::dot(normal, is_low ? low : high)};
    }
    return planes;
}

Frustum frustumFromClip(const glm::dmat4& clip_from_world)
{
    const glm::dmat4 rows = glm::transpose(clip_from_world);
    const auto size = [&](int row) {
        return glm::length(glm::dvec3(rows[row]));
    };
    // -w <= x becomes row3 + row0 >= 0, and so on.
    Frustum frustum;
    for (int axis = 0; axis < 2; ++axis) {
        const double scale = std::max(size(axis), size(3));
        frustum.planes[static_cast<std::size_t>(2 * axis)] = planeFromRow(rows[3] + rows[axis], scale);
        frustum.planes[static_cast<std::size_t>(2 * axis + 1)] = planeFromRow(rows[3] - rows[axis], scale);
    }
    const double scale = std::max(size(2), size(3));
    frustum.planes[4] = planeFromRow(rows[2], scale);
    frustum.planes[5] = planeFromRow(rows[3] - rows[2], scale);
    return frustum;
}

Containment classify(std::span<const Plane> planes, const Aabb& box)
{
    const glm::dvec3 low(box.min);
    const glm::dvec3 high(box.max);
    Containment found = Containment::inside;
    for (const Plane& plane : planes) {
        // The corner farthest along the normal decides "outside", the opposite one "inside".
        const glm::bvec3 positive = glm::greaterThanEqual(plane.normal, glm::dvec3(0.0));
        const glm::dvec3 far_corner = glm::mix(low, high, positive);
        if (plane.distance(far_corner) < 0.0) {
            return Containment::outside;
        }
        const glm::dvec3 near_corner = glm::mix(high, low, positive);
        if (plane.distance(near_corner) < 0.0) {
            found = Containment::intersects;
        }
    }
    return found;
}

} // namespace gnomon
