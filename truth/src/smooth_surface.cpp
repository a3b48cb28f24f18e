// SPDX-License-Identifier: Apache-2.0
#include "smooth_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::truth {
namespace {

/// Shares of the three vertices in a point of the triangle.
std::array<double, 3> sharesAt(const Triangle& triangle, const glm::dvec3& rel)
{
    const glm::dvec3 a = triangle.rel[1] - triangle.rel[0];
    const glm::dvec3 b = triangle.rel[2] - triangle.rel[0];
    const glm::dvec3 across = glm::cross(a, b);
    const glm::dvec3 to = rel - triangle.rel[0];
    const double area2 = glm::dot(across, across);
    const double second = glm::dot(glm::cross(to, b), across) / area2;
    const double third = glm::dot(glm::cross(a, to), across) / area2;
    return {1.0 - second - third, second, third};
}

} // namespace

SmoothPoint smoothPoint(const Triangle& triangle, const std::array<glm::dvec3, 3>& vertex_normals,
                        const glm::dvec3& rel, const glm::dvec3& normal)
{
    const SmoothPoint flat{normal, 0.0};
    const std::array<double, 3> shares = sharesAt(triangle, rel);
    glm::dvec3 sum(0.0);
    double above = 0.0; // the height of the planes over the point, along the sum
    for (std::size_t k = 0; k < 3; ++k) {
        sum += vertex_normals[k] * shares[k];
        above += shares[k] * glm::dot(vertex_normals[k], triangle.rel[k] - rel);
    }
    const double length = glm::length(sum);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return flat;
    }
    const double side = glm::dot(sum, normal) < 0.0 ? -1.0 : 1.0;
    const SmoothPoint smooth{sum * (side / length), side * above / length};
    const double edge_m =
        std::max({glm::distance(triangle.rel[0], triangle.rel[1]), glm::distance(triangle.rel[1], triangle.rel[2]),
                  glm::distance(triangle.rel[2], triangle.rel[0])});
    return smooth.lift_m > kLeastLift * edge_m && glm::length(smooth.normal - normal) >= kFlat ? smooth : flat;
}

} // namespace gnomon::truth
