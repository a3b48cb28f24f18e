// SPDX-License-Identifier: Apache-2.0
#include "auto/map_error.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// The mean of the squared sides of a texel, in pixels, as a length; infinite where the light grazes the receiver.
double texelInPixels(const LitPoint& point, const Warp& warp, const MapFrame& frame)
{
    const glm::dmat2 m = texelFromPixel(point, warp, frame);
    // The columns of the inverse are the texel's two sides in pixels.
    const double squares = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]);
    return std::sqrt(0.5 * squares) / std::abs(glm::determinant(m));
}

/// The size that all but a fiftieth have at most; 0 of none. Reorders them.
double coarsestOf(std::vector<double>& sizes)
{
    if (sizes.empty()) {
        return 0.0;
    }
    std::ranges::replace_if(
        sizes, [](double size) { return std::isnan(size); }, std::numeric_limits<double>::infinity());
    const auto coarsest = sizes.end() - 1 - static_cast<std::ptrdiff_t>(sizes.size() / 50);
    std::nth_element(sizes.begin(), coarsest, sizes.end());
    return *coarsest;
}

} // namespace

std::optional<LitPoint> litPoint(const LightSpace& space, const SightPoint& point)
{
    const glm::dvec3 c = space.coordinates(point.p_ws);
    const bool in_reach = !space.perspective || (c.z > space.near_m && c.z < space.reach_m &&
                                                 std::max(std::abs(c.x), std::abs(c.y)) < c.z * space.tangent);
    if (!in_reach) {
        return std::nullopt;
    }
    const auto step = [&](const glm::dvec3& d_ws) {
        const glm::dvec2 across(glm::dot(space.right_ws, d_ws), glm::dot(space.up_ws, d_ws));
        return space.perspective ? (across - glm::dvec2(c) * (glm::dot(space.depth_ws, d_ws) / c.z)) / c.z : across;
    };
    return LitPoint{glm::dvec2(space.project(point.p_ws)),
                    {step(point.right_ws), step(point.down_ws)},
                    point.pixel_m,
                    space.perspective ? point.facing_m / c.z : point.facing_m};
}

void lightPoints(const LightSpace& space, std::span<const SightPoint> points, const ViewSlice& depths,
                 const ViewSector& sector, std::vector<LitPoint>& out)
{
    for (const SightPoint& point : points) {
        const double unit = glm::dot(depths.over, glm::dvec4(point.p_ws, 1.0));
        if (point.depth_m < depths.begin_m * unit || point.depth_m >= depths.end_m * unit ||
            !sector.holds(point.p_ws)) {
            continue;
        }
        if (const std::optional<LitPoint> lit = litPoint(space, point)) {
            out.push_back(*lit);
        }
    }
}

glm::dmat2 texelFromPixel(const LitPoint& point, const Warp& warp, const MapFrame& frame)
{
    // Differentials of Warp's x = (b - upright) / w and y = (s - nearest) / w: dx = db / w - (b - upright) ds / (n
    // w^2), and
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

MapError mapErrorOf(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame, double feature_m,
                    double finest_px)
{
    MapError error;
    for (const LitPoint& point : points) {
        const double texel_px = texelInPixels(point, warp, frame);
        const double texel_m = std::max(texel_px, finest_px) * point.pixel_m;
        error.sum += std::isfinite(texel_m) ? texel_m / (texel_m + feature_m) : 1.0;
        error.log_texels -= std::isfinite(texel_px) && texel_px > 0.0 ? std::log(texel_px) : 0.0;
    }
    error.count = points.size();
    return error;
}

BySize edgesBySize(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame, double feature_m,
                   std::uint32_t halvings)
{
    BySize logs{};
    for (const LitPoint& point : points) {
        const double texel_px = texelInPixels(point, warp, frame);
        for (std::uint32_t i = 0; i < logs.size(); ++i) {
            const double sized_px = std::ldexp(texel_px, static_cast<int>(i) - static_cast<int>(halvings));
            const double texel_m = std::max(sized_px, kFineEnough_px) * point.pixel_m;
            logs[i] += std::isfinite(texel_m) ? std::log(texel_m / (texel_m + feature_m)) : 0.0;
        }
    }
    return logs;
}

double coarsestTexel_px(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame,
                        std::vector<double>& scratch)
{
    scratch.clear();
    for (const LitPoint& point : points) {
        scratch.push_back(texelInPixels(point, warp, frame));
    }
    return coarsestOf(scratch);
}

FacingTexels facingTexels(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame,
                          std::vector<double>& scratch)
{
    FacingTexels found;
    scratch.clear();
    for (LitPoint point : points) {
        point.q_from_pixel = glm::dmat2(point.facing);
        scratch.push_back(texelInPixels(point, warp, frame));
        found.sum_px += std::isfinite(scratch.back()) ? scratch.back() : 0.0;
    }
    found.coarsest_px = coarsestOf(scratch);
    return found;
}

} // namespace gnomon
