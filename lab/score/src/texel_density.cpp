// SPDX-License-Identifier: Apache-2.0
#include "lab/score/texel_density.h"

#include "lab/metrics/quantile.h"
#include "lab/metrics/same_shape.h"
#include "pixel_rays.h"

#include <gnomon/plan_views.h>

#include <glm/mat2x2.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace gnomon::lab {
namespace {

struct Densities {
    double of_surface = 0.0;
    double facing = 0.0;
};

/// With J = d(texel)/d(pixel), one texel step along axis i moves the pixel by column i of J^-1. Nothing where J has no
/// inverse.
std::optional<double> densityOf(const glm::dmat2& texel_from_pixel)
{
    if (!(std::abs(glm::determinant(texel_from_pixel)) >= 1e-12)) {
        return std::nullopt;
    }
    const glm::dmat2 pixel_from_texel = glm::inverse(texel_from_pixel);
    return 1.0 / std::max(glm::length(pixel_from_texel[0]), glm::length(pixel_from_texel[1]));
}

/// On a square of a pixel's size that faces the light: the texel's gradients are both across its rays.
double facingDensity(const PixelRays& rays, const View& view, glm::dvec2 pixel, const glm::dvec3& point_ws)
{
    const double side_m = rays.facingPixel_m(pixel, point_ws);
    const double step_m = 0.01 * side_m;
    glm::dvec3 x(0.0);
    glm::dvec3 y(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = step_m;
        const auto before = texelOf(view, point_ws - step);
        const auto after = texelOf(view, point_ws + step);
        if (!before || !after) {
            return 0.0;
        }
        x[axis] = (after->x - before->x) / (2.0 * step_m);
        y[axis] = (after->y - before->y) / (2.0 * step_m);
    }
    const double length = glm::length(x);
    const glm::dvec3 along = x / length;
    const glm::dvec3 across = y - along * glm::dot(along, y);
    const glm::dmat2 texel_from_pixel(glm::dvec2(length, glm::dot(along, y)) * side_m,
                                      glm::dvec2(0.0, glm::length(across)) * side_m);
    return densityOf(texel_from_pixel).value_or(0.0);
}

std::optional<Densities> densitiesIn(const PixelRays& rays, const View& view, glm::dvec2 pixel, const Surface& surface,
                                     double reach_texels)
{
    const auto here = texelOf(view, surface.point_ws);
    if (!here || !serves(view, surface.point_ws, *here, reach_texels)) {
        return std::nullopt;
    }
    constexpr double kStep = 0.25; // pixels; smaller than a pixel, so that a grazing plane's horizon stays away
    const auto right = texelOf(view, rays.onPlane(pixel + glm::dvec2(kStep, 0.0), surface));
    const auto down = texelOf(view, rays.onPlane(pixel + glm::dvec2(0.0, kStep), surface));
    if (!right || !down) {
        return std::nullopt;
    }
    const auto of_surface = densityOf({(*right - *here) / kStep, (*down - *here) / kStep});
    if (!of_surface) {
        return std::nullopt;
    }
    return Densities{*of_surface, facingDensity(rays, view, pixel, surface.point_ws)};
}

/// In the first of the light's views that has the surface.
std::optional<Densities> densitiesOf(const PixelRays& rays, std::span<const View> views, glm::dvec2 pixel,
                                     const Surface& surface, double reach_texels)
{
    for (const View& view : views) {
        if (const auto found = densitiesIn(rays, view, pixel, surface, reach_texels)) {
            return found;
        }
    }
    return std::nullopt;
}

FacingDensity summaryOf(std::vector<double>& densities)
{
    FacingDensity summary;
    if (!densities.empty()) {
        std::sort(densities.begin(), densities.end());
        summary.p01 = quantile(densities, 0.01);
        summary.p50 = quantile(densities, 0.50);
        summary.p99 = quantile(densities, 0.99);
        const auto counts = std::ranges::count_if(densities, [](double d) { return d >= 1.0 && d <= 4.0; });
        summary.one_to_four = static_cast<double>(counts) / static_cast<double>(densities.size());
    }
    return summary;
}

template <typename Holds>
Counted pixelsWhere(const Sight& seen, const Holds& holds)
{
    const PixelRays rays(seen);
    Counted counted(seen.depth.width, seen.depth.height, 1);
    for (std::uint32_t y = 0; y < counted.height; ++y) {
        for (std::uint32_t x = 0; x < counted.width; ++x) {
            const auto surface = rays.surfaceAt(x, y);
            *counted.pixel(x, y) = surface && holds(*surface) ? 1 : 0;
        }
    }
    return counted;
}

} // namespace

TexelDensity texelDensity(const Sight& seen, const Counted& counted, const Plan& plan, std::uint32_t light,
                          double reach_texels)
{
    assert(areMasksOfOneSize(counted, seen.depth) && seen.normals.channels == 3);
    assert(light < plan.lights.size());
    const PixelRays rays(seen);
    const std::span<const View> views = viewsOf(plan, light, strongerPosition(plan.lights[light].steps));
    TexelDensity result;
    result.map = ImageF(counted.width, counted.height, 1);
    std::vector<double> densities;
    std::vector<double> facing;
    for (std::uint32_t y = 0; y < counted.height; ++y) {
        for (std::uint32_t x = 0; x < counted.width; ++x) {
            const auto surface = rays.surfaceAt(x, y);
            if (!surface) {
                continue;
            }
            std::optional<Densities> found;
            if (*counted.pixel(x, y) != 0) {
                found = densitiesOf(rays, views, {x + 0.5, y + 0.5}, *surface, reach_texels);
            }
            if (found) {
                densities.push_back(found->of_surface);
                facing.push_back(found->facing);
                *result.map.pixel(x, y) = static_cast<float>(found->of_surface);
            } else {
                ++result.left_out;
            }
        }
    }
    result.counted = densities.size();
    const FacingDensity of_surfaces = summaryOf(densities);
    result.p01 = of_surfaces.p01;
    result.p50 = of_surfaces.p50;
    result.p99 = of_surfaces.p99;
    result.facing = summaryOf(facing);
    return result;
}

Counted facingPixels(const Sight& seen, const Light& light)
{
    return pixelsWhere(seen, [&](const Surface& surface) {
        return glm::dot(surface.normal_ws, towardsLight(light, surface.point_ws)) > kFacing;
    });
}

Counted reachedPixels(const Sight& seen, const Light& light)
{
    return pixelsWhere(seen, [&](const Surface& surface) { return shinesOn(light, surface.point_ws); });
}

} // namespace gnomon::lab
