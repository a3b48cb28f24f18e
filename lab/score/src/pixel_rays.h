// SPDX-License-Identifier: Apache-2.0
// From pixels to the surface that they see, and from there to texels.
#pragma once

#include "lab/score/texel_density.h"

#include <gnomon/plan_views.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::lab {

/// One pixel's surface: a point and the plane through it.
struct Surface {
    glm::dvec3 point_ws;
    glm::dvec3 normal_ws;
};

class PixelRays {
public:
    explicit PixelRays(const Sight& seen)
        : seen_(seen), world_from_clip_(glm::inverse(clipFromWorld(seen.camera))),
          size_px_(seen.depth.width, seen.depth.height)
    {
    }
    /// `pixel` in pixels from the top left; a pixel's centre is at half.
    [[nodiscard]] glm::dvec3 point(glm::dvec2 pixel, double depth) const
    {
        const glm::dvec2 ndc = pixel / size_px_ * 2.0 - 1.0;
        const glm::dvec4 p = world_from_clip_ * glm::dvec4(ndc, depth, 1.0);
        return glm::dvec3(p) / p.w;
    }
    /// Where the ray through a pixel meets the surface's plane.
    [[nodiscard]] glm::dvec3 onPlane(glm::dvec2 pixel, const Surface& surface) const
    {
        const glm::dvec3& eye_ws = seen_.camera.eye_ws;
        const glm::dvec3 direction = point(pixel, 0.5) - eye_ws;
        const double t =
            glm::dot(surface.normal_ws, surface.point_ws - eye_ws) / glm::dot(surface.normal_ws, direction);
        return eye_ws + direction * t;
    }
    /// Side of a pixel, metres, on a surface through the point that faces the eye.
    [[nodiscard]] double facingPixel_m(glm::dvec2 pixel, const glm::dvec3& point_ws) const
    {
        const glm::dvec2 middle = size_px_ * 0.5;
        const Surface facing{point_ws, glm::normalize(point(middle, 0.25) - point(middle, 0.75))};
        return glm::distance(onPlane(pixel, facing), onPlane(pixel + glm::dvec2(0.0, 1.0), facing));
    }
    /// The surface that pixel (x, y) sees; nothing at background.
    [[nodiscard]] std::optional<Surface> surfaceAt(std::uint32_t x, std::uint32_t y) const
    {
        const double depth = *seen_.depth.pixel(x, y);
        if (seen_.camera.reversed_z ? depth <= 0.0 : depth >= 1.0) {
            return std::nullopt;
        }
        const float* normal = seen_.normals.pixel(x, y);
        return Surface{point({x + 0.5, y + 0.5}, depth), {normal[0], normal[1], normal[2]}};
    }

private:
    const Sight& seen_;
    glm::dmat4 world_from_clip_;
    glm::dvec2 size_px_;
};

/// A light's views; none when it has no map.
inline std::span<const View> viewsOf(const Plan& plan, std::uint32_t light)
{
    const LightPlan& light_plan = plan.lights[light];
    if (!light_plan.outcome.hasMap()) {
        return {};
    }
    return std::span(plan.views).subspan(light_plan.first_view, light_plan.view_count);
}

/// Texel coordinates within the view's tile, unbounded; nothing behind the view.
inline std::optional<glm::dvec2> texelOf(const View& view, const glm::dvec3& point_ws)
{
    const std::optional<glm::dvec2> place = placeOnMap(view, point_ws);
    if (!place) {
        return std::nullopt;
    }
    return (*place * 0.5 + 0.5) * glm::dvec2(view.place.tile.width, view.place.tile.height);
}

/// Does the mask take this view for a receiver at a point, whose place in the map is `texel`?
inline bool serves(const View& view, const glm::dvec3& point_ws, const glm::dvec2& texel, double reach_texels)
{
    if (!view.serves.slice.holds(point_ws) || !view.serves.sector.holds(point_ws)) {
        return false;
    }
    const double margin = tileMarginTexels(reach_texels);
    return texel.x >= margin && texel.y >= margin && texel.x <= view.place.tile.width - margin &&
           texel.y <= view.place.tile.height - margin;
}

/// Unit, from a point to the light's centre.
inline glm::dvec3 towardsLight(const Light& light, const glm::dvec3& point_ws)
{
    return light.type == LightType::directional ? -light.direction_ws : glm::normalize(light.position_ws - point_ws);
}

/// Does the light shine on a point at all, if nothing is in the way?
inline bool shinesOn(const Light& light, const glm::dvec3& point_ws)
{
    if (light.type == LightType::directional) {
        return true;
    }
    const glm::dvec3 ray = point_ws - light.position_ws;
    const double distance = glm::length(ray);
    if (light.range_m > 0.0 && distance > light.range_m) {
        return false;
    }
    return light.type != LightType::spot ||
           glm::dot(ray, light.direction_ws) > std::cos(light.outer_half_angle_rad) * distance;
}

} // namespace gnomon::lab
