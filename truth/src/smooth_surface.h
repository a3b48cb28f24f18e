// SPDX-License-Identifier: Apache-2.0
// The smooth surface that a mesh's normals stand for, over its flat triangles. Based on: J. Hanika, "Hacking the Shadow
// Terminator", Ray Tracing Gems II, 2021.
#pragma once

#include "scene_geometry.h"

#include <glm/vec3.hpp>

#include <array>

namespace gnomon::truth {

/// Below this distance between the two unit normals a triangle counts as flat: vertices hold normals of 16 bits, and
/// files hold flat ones that were rounded.
inline constexpr double kFlat = 0.004;
/// A triangle also counts as flat where the smooth surface lies no more than this share of its longest edge over it.
/// All corners of a card of foliage have one normal that is not its own; no body is smooth there.
inline constexpr double kLeastLift = 1e-6;

struct SmoothPoint {
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit, on the side of the triangle's normal that was given
    double lift_m = 0.0;              // how far along it the smooth surface lies over the point; 0: there is none
};

/// The smooth surface over a point `rel` on `triangle`, whose unit normal on the visible side is `normal`.
///
/// Each vertex has the plane through it that is perpendicular to its normal. The three planes, interpolated over the
/// triangle, give every point a plane of its own, and its normal is the interpolated one. The smooth surface is where
/// that normal meets that plane. Departures from Hanika: he moves the point onto the three planes first and
/// interpolates then, and leaves out each plane that the point is above. For normals a few degrees apart both are the
/// same to second order. Ours needs nothing but interpolated numbers, so a rasteriser can do the same. For a ball whose
/// vertices have the ball's normals it is exactly the inverse point, R^2 / |p| from the centre, from where no ray above
/// the horizon meets the ball.
[[nodiscard]] SmoothPoint smoothPoint(const Triangle& triangle, const std::array<glm::dvec3, 3>& vertex_normals,
                                      const glm::dvec3& rel, const glm::dvec3& normal);

} // namespace gnomon::truth
