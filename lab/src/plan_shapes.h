// SPDX-License-Identifier: Apache-2.0
// Shapes of a plan in the plane across a light: for pictures of plans.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::lab {

/// Corners in order; empty: nothing to draw.
using Polygon = std::vector<glm::dvec2>;

/// The plane across a light's rays as the light sees it: a point of it is a ray. Metres under parallel light; else
/// metres at 1 m distance from the light (tangents).
struct LightPlane {
    glm::dvec3 origin_ws{0.0}; // where (0, 0) is; the light's place when `perspective`
    glm::dvec3 x_ws{1.0, 0.0, 0.0};
    glm::dvec3 y_ws{0.0, 0.0, -1.0}; // as near as can be to the way the camera looks
    glm::dvec3 forward_ws{0.0, -1.0, 0.0};
    bool perspective = false;

    /// Nothing for a point that is not in front of a light with a place.
    [[nodiscard]] std::optional<glm::dvec2> project(const glm::dvec3& p_ws) const;
};
/// Across the axis of `view`.
[[nodiscard]] LightPlane lightPlaneOf(const View& view, const Camera& camera);
/// The level plane at a light's place, seen from above, in metres; for a light that has maps all around it.
[[nodiscard]] LightPlane planeFromAbove(const glm::dvec3& place_ws, const Camera& camera);

/// The unit vector along which the camera looks.
[[nodiscard]] glm::dvec3 forwardOf(const Camera& camera);

/// Takes (x, y, 1) of the plane to clip space's x, y and w.
[[nodiscard]] glm::dmat3 mapFromPlane(const LightPlane& plane, const View& view);
/// The map's point at clip space (x, y), as a point of the plane.
[[nodiscard]] glm::dvec2 planePoint(const glm::dmat3& map_from_plane, double x, double y);

inline constexpr std::array<glm::dvec2, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}; // corners of a map
/// A map as its own plane has it.
struct MapInPlane {
    LightPlane plane;
    glm::dmat3 from_plane{1.0};
};
/// The pyramid that a map of a light with a place covers, `reach_m` high, in `plane`.
[[nodiscard]] Polygon pyramidOf(const LightPlane& plane, const MapInPlane& map, double reach_m);

/// The part of a convex body in front of the light, as the light sees it: convex, counter-clockwise.
[[nodiscard]] Polygon shadowOf(const LightPlane& plane, ConvexBody body);

/// The hull of the visible parts of the plan's receivers' boxes within a view's slice and the light's reach, as the
/// light sees them: convex, counter-clockwise. The map must contain it.
[[nodiscard]] Polygon seenFrom(const LightPlane& plane, const Frame& frame, const Plan& plan, const View& view);

/// The part of a convex polygon that `window_from_plane` takes to |x|, |y| <= `half` with w > 0, in the window.
[[nodiscard]] Polygon inWindow(std::span<const glm::dvec2> polygon, const glm::dmat3& window_from_plane, double half);

} // namespace gnomon::lab
