// SPDX-License-Identifier: Apache-2.0
#include "auto/map_error.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Finer texels gain nothing, pixels.
constexpr double kFinestTexel_px = 0.5;

} // namespace

void lightPoints(const LightSpace& space, std::span<const SightPoint> points, const ViewSlice& depths,
                 std::vector<LitPoint>& out)
{
    for (const SightPoint& point : points) {
        if (point.depth_m < depths.begin_m || point.depth_m >= depths.end_m) {
            continue;
        }
        const glm::dvec3 c = space.coordinates(point.p_ws);
        const bool in_reach = !space.perspective || (c.z > space.near_m && c.z < space.reach_m &&
                                                     std::max(std::abs(c.x), std::abs(c.y)) < c.z * space.tangent);
        if (!in_reach) {
            continue;
        }
        const auto step = [&](const glm::dvec3& d_ws) {
            const glm::dvec2 across(glm::dot(space.right_ws, d_ws), glm::dot(space.up_ws, d_ws));
            return space.perspective ? (across - glm::dvec2(c) * (glm::dot(space.depth_ws, d_ws) / c.z)) / c.z : across;
        };
        LitPoint lit;
        lit.q = glm::dvec2(space.project(point.p_ws));
        lit.q_from_pixel = {step(point.right_ws), step(point.down_ws)};
        lit.pixel_m = point.pixel_m;
        out.push_back(lit);
    }
}

glm::dmat2 texelFromPixel(const LitPoint& point, const Warp& warp, const MapFrame& frame)
{
    // Of Warp's x = (b - upright) / w and y = (s - nearest) / w: dx = db / w - (b - upright) ds / (n w^2), and
    // dy = ds / w^2, because w grows by ds / n.
    const double w = warp.wAt(point.q);
    const double turned = warp.warped() ? (glm::dot(warp.across(), point.q) - warp.upright) / (warp.n * w * w) : 0.0;
    const glm::dvec2 across = warp.across();
    const auto texels = [&](const glm::dvec2& dq) {
        const double ds = glm::dot(warp.along, dq);
        return glm::dvec2(glm::dot(across, dq) / w - turned * ds, ds / (w * w)) / frame.texel;
    };
    return {texels(point.q_from_pixel[0]), texels(point.q_from_pixel[1])};
}

MapError mapErrorOf(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame, double feature_m)
{
    MapError error;
    for (const LitPoint& point : points) {
        const glm::dmat2 m = texelFromPixel(point, warp, frame);
        // The columns of the inverse are the texel's two sides in pixels; their mean square.
        const double squares = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]);
        const double texel_px = std::sqrt(0.5 * squares) / std::abs(glm::determinant(m));
        const double texel_m = std::max(texel_px, kFinestTexel_px) * point.pixel_m;
        // Where the light grazes the receiver a texel has no end.
        error.sum += std::isfinite(texel_m) ? texel_m / (texel_m + feature_m) : 1.0;
        error.log_texels -= std::isfinite(texel_px) && texel_px > 0.0 ? std::log(texel_px) : 0.0;
    }
    error.count = points.size();
    return error;
}

} // namespace gnomon
