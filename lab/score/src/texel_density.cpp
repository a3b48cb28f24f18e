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

/// With J = d(texel)/d(pixel), one texel step along axis i moves the pixel by column i of J^-1.
std::optional<double> densityIn(const PixelRays& rays, const View& view, glm::dvec2 pixel, const Surface& surface,
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
    const glm::dmat2 texel_from_pixel((*right - *here) / kStep, (*down - *here) / kStep);
    if (std::abs(glm::determinant(texel_from_pixel)) < 1e-12) {
        return std::nullopt;
    }
    const glm::dmat2 pixel_from_texel = glm::inverse(texel_from_pixel);
    return 1.0 / std::max(glm::length(pixel_from_texel[0]), glm::length(pixel_from_texel[1]));
}

/// In the first of the light's views that has the surface.
std::optional<double> densityOf(const PixelRays& rays, std::span<const View> views, glm::dvec2 pixel,
                                const Surface& surface, double reach_texels)
{
    for (const View& view : views) {
        if (const auto density = densityIn(rays, view, pixel, surface, reach_texels)) {
            return density;
        }
    }
    return std::nullopt;
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
    for (std::uint32_t y = 0; y < counted.height; ++y) {
        for (std::uint32_t x = 0; x < counted.width; ++x) {
            const auto surface = rays.surfaceAt(x, y);
            if (!surface) {
                continue;
            }
            std::optional<double> density;
            if (*counted.pixel(x, y) != 0) {
                density = densityOf(rays, views, {x + 0.5, y + 0.5}, *surface, reach_texels);
            }
            if (density) {
                densities.push_back(*density);
                *result.map.pixel(x, y) = static_cast<float>(*density);
            } else {
                ++result.left_out;
            }
        }
    }
    result.counted = densities.size();
    if (!densities.empty()) {
        std::sort(densities.begin(), densities.end());
        result.p01 = quantile(densities, 0.01);
        result.p50 = quantile(densities, 0.50);
        result.p99 = quantile(densities, 0.99);
    }
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
