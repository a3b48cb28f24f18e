// SPDX-License-Identifier: Apache-2.0
// Where a light's frustum stands and how it is turned, and what of a light can be planned at all.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace gnomon {

/// A rectangle across the light: metres for parallel rays, metres at 1 m distance (tangents) for a light with a place.
struct LightRect {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
};

/// Right-handed axes of a light and the point they are measured from; `forward` is the way light travels.
struct LightSpace {
    glm::dvec3 origin_ws{0.0}; // the light's place when `perspective`
    glm::dvec3 right_ws{1.0, 0.0, 0.0};
    glm::dvec3 up_ws{0.0, 0.0, -1.0};
    glm::dvec3 forward_ws{0.0, -1.0, 0.0};
    /// Gradient of depth: forward_ws itself, or under parallel light one that leans (depth_tilt.h).
    glm::dvec3 depth_ws{0.0, -1.0, 0.0};
    bool perspective = false;
    double near_m = 0.0; // perspective: depths that count, along `forward`
    double reach_m = 0.0;
    double tangent = 0.0; // perspective: of the half angle

    /// Coordinates along right and up, and depth; metres.
    [[nodiscard]] glm::dvec3 coordinates(const glm::dvec3& p_ws) const
    {
        const glm::dvec3 p = p_ws - origin_ws;
        return {glm::dot(right_ws, p), glm::dot(up_ws, p), glm::dot(depth_ws, p)};
    }
    /// The same with x and y as LightRect has them. Perspective: depth must be > 0.
    [[nodiscard]] glm::dvec3 project(const glm::dvec3& p_ws) const
    {
        const glm::dvec3 c = coordinates(p_ws);
        return perspective ? glm::dvec3(c.x / c.z, c.y / c.z, c.z) : c;
    }
};

/// ok, or why this light cannot have a map whatever it shines on.
[[nodiscard]] Outcome checkLight(const Light& light);

/// Does the cone of a light that has a place, if it has one, reach into the cone of this axis (unit) and half angle?
[[nodiscard]] bool shinesInto(const Light& light, const glm::dvec3& axis_ws, double half_angle_rad);

/// Precondition: checkLight() is ok. `axis_ws` unit; `scene_ws` not empty (it bounds a reach of 0).
[[nodiscard]] LightSpace lightSpaceOf(const Light& light, const glm::dvec3& axis_ws, double half_angle_rad,
                                      const Aabb& scene_ws);

/// The near distance of a light that gives none, metres: extentOf()'s, or less where the bounds of a caster begin
/// nearer. Preconditions: as lightSpaceOf(); the light is a spot or point light. `scratch` keeps memory between calls.
[[nodiscard]] double nearBefore(const Light& light, const ObjectSet& objects, std::vector<std::uint32_t>& scratch);

/// Two axes across `forward_ws`, which depend on nothing else.
void axesAcross(const glm::dvec3& forward_ws, glm::dvec3& right_ws, glm::dvec3& up_ws);

} // namespace gnomon
