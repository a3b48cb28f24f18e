// SPDX-License-Identifier: Apache-2.0
#include "texel_density.h"

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::app {
namespace {

constexpr double kFacing = 0.05; // below, a pixel sees the terminator, whose error is shading's

/// One pixel's surface: a point and the plane through it.
struct Surface {
    glm::dvec3 point_ws;
    glm::dvec3 normal_ws;
};

class PixelRays {
public:
    PixelRays(const Camera& camera, glm::dvec2 size_px)
        : eye_ws_(camera.eye_ws), world_from_clip_(glm::inverse(camera.clip_from_world)), size_px_(size_px)
    {
    }
    [[nodiscard]] glm::dvec3 point(glm::dvec2 pixel, double depth) const
    {
        const glm::dvec2 ndc = pixel / size_px_ * 2.0 - 1.0;
        const glm::dvec4 p = world_from_clip_ * glm::dvec4(ndc, depth, 1.0);
        return glm::dvec3(p) / p.w;
    }
    /// Where the ray through a pixel meets the surface's plane.
    [[nodiscard]] glm::dvec3 onPlane(glm::dvec2 pixel, const Surface& surface) const
    {
        const glm::dvec3 direction = point(pixel, 0.5) - eye_ws_;
        const double t =
            glm::dot(surface.normal_ws, surface.point_ws - eye_ws_) / glm::dot(surface.normal_ws, direction);
        return eye_ws_ + direction * t;
    }

private:
    glm::dvec3 eye_ws_;
    glm::dmat4 world_from_clip_;
    glm::dvec2 size_px_;
};

/// Texel coordinates within the view's tile; nothing outside of it or behind it.
std::optional<glm::dvec2> texelOf(const View& view, const glm::dvec3& point_ws)
{
    const glm::dvec4 clip = view.clip_from_world * glm::dvec4(point_ws, 1.0);
    if (clip.w <= 0.0) {
        return std::nullopt;
    }
    return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(view.tile.width, view.tile.height);
}

bool inside(const View& view, const glm::dvec2& texel)
{
    return texel.x >= 0.0 && texel.y >= 0.0 && texel.x <= view.tile.width && texel.y <= view.tile.height;
}

/// With J = d(texel)/d(pixel), one texel step along axis i moves the pixel by column i of J^-1.
std::optional<double> densityAt(const PixelRays& rays, const View& view, glm::dvec2 pixel, const Surface& surface)
{
    const auto here = texelOf(view, surface.point_ws);
    if (!here || !inside(view, *here)) {
        return std::nullopt;
    }
    constexpr double kStep = 0.25; // pixels; smaller than a pixel, so that a grazing plane's horizon stays away
    const auto right = texelOf(view, rays.onPlane(pixel + glm::dvec2(kStep, 0.0), surface));
    const auto down = texelOf(view, rays.onPlane(pixel + glm::dvec2(0.0, kStep), surface));
    if (!right || !down) {
        return std::nullopt;
    }
    const glm::dmat2 texel_from_pixel((*right - *here) / kStep, (*down - *here) / kStep);
    if (std::abs(glm::determinant(texel_from_pixel)) < 1e-12) {
        return std::nullopt;
    }
    const glm::dmat2 pixel_from_texel = glm::inverse(texel_from_pixel);
    return 1.0 / std::max(glm::length(pixel_from_texel[0]), glm::length(pixel_from_texel[1]));
}

glm::dvec3 towards(const Light& light, const glm::dvec3& point_ws)
{
    return light.type == LightType::directional ? -light.direction_ws : glm::normalize(light.position_ws - point_ws);
}

double percentile(std::vector<double>& values, double share)
{
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

} // namespace

TexelDensity texelDensity(const host::Picture& picture, const Camera& camera, const Plan& plan,
                          std::span<const Light> lights, std::uint32_t light)
{
    const LightPlan& light_plan = plan.lights[light];
    const PixelRays rays(camera, {picture.depth.width, picture.depth.height});
    std::vector<double> densities;
    TexelDensity result;
    for (std::uint32_t y = 0; y < picture.depth.height; ++y) {
        for (std::uint32_t x = 0; x < picture.depth.width; ++x) {
            const auto depth = static_cast<double>(*picture.depth.pixel(x, y));
            if (depth <= 0.0) {
                continue; // background
            }
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const float* normal = picture.normals.pixel(x, y);
            const Surface surface{rays.point(pixel, depth), {normal[0], normal[1], normal[2]}};
            std::optional<double> density;
            if (glm::dot(surface.normal_ws, towards(lights[light], surface.point_ws)) > kFacing) {
                for (std::uint32_t v = 0; v < light_plan.view_count && !density; ++v) {
                    density = densityAt(rays, plan.views[light_plan.first_view + v], pixel, surface);
                }
            }
            density ? densities.push_back(*density) : void(++result.left_out);
        }
    }
    result.counted = densities.size();
    if (!densities.empty()) {
        result.p01 = percentile(densities, 0.01);
        result.p50 = percentile(densities, 0.50);
        result.p99 = percentile(densities, 0.99);
    }
    return result;
}

} // namespace gnomon::app
