// SPDX-License-Identifier: Apache-2.0
#include "lab/score/view_shares.h"

#include "pixel_rays.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cassert>

namespace gnomon::lab {
namespace {

/// Shares `weight` out among views, in the order in which they fade over into each other.
void shareOut(std::span<const View> views, const glm::dvec3& point_ws, double reach_texels, double weight,
              float* shares)
{
    bool found = false;
    double left = 1.0; // with layered views: the share that earlier ones leave
    for (std::size_t i = 0; i < views.size(); ++i) {
        const View& view = views[i];
        const auto texel = texelOf(view, point_ws);
        if (!texel || !serves(view, point_ws, *texel, reach_texels)) {
            continue;
        }
        // The first that serves the point counts for all of it, and each after it for what has faded over so far.
        double share = 1.0;
        if (view.serves.layered) {
            const double counts = std::min(left, std::max(view.serves.opacityAt(point_ws), 1e-4));
            left -= counts;
            share = counts > 0.0 ? counts / (1.0 - left) : 0.0;
        } else if (found) {
            share = view.serves.shareAt(view.serves.slice.depthAt(point_ws));
        }
        for (std::size_t before = 0; before < i; ++before) {
            shares[before] *= static_cast<float>(1.0 - share);
        }
        shares[i] = static_cast<float>(share * weight);
        found = true;
    }
}

} // namespace

ImageF viewShares(const Sight& seen, const Plan& plan, std::uint32_t light, double reach_texels)
{
    assert(light < plan.lights.size());
    const PixelRays rays(seen);
    const std::span<const View> views = viewsOf(plan, light);
    const SunSteps& steps = plan.lights[light].steps;
    const auto later = std::find_if(views.begin(), views.end(), [&](const View& view) {
        return steps.paired && view.serves.sun == SunPosition::later;
    });
    const auto earlier_count = static_cast<std::size_t>(later - views.begin());
    ImageF shares(seen.depth.width, seen.depth.height, std::max<std::uint32_t>(1, std::uint32_t(views.size())));
    for (std::uint32_t y = 0; y < shares.height; ++y) {
        for (std::uint32_t x = 0; x < shares.width; ++x) {
            const auto surface = rays.surfaceAt(x, y);
            if (!surface) {
                continue;
            }
            const double weight = steps.paired ? laterWeight(steps, (x + 0.5) / shares.width) : 0.0;
            float* const here = shares.pixel(x, y);
            shareOut(views.first(earlier_count), surface->point_ws, reach_texels, 1.0 - weight, here);
            shareOut(views.subspan(earlier_count), surface->point_ws, reach_texels, weight, here + earlier_count);
        }
    }
    return shares;
}

} // namespace gnomon::lab
