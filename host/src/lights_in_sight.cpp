// SPDX-License-Identifier: Apache-2.0
// Which lights of many a frame is lit by.
#include "host/view.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace gnomon::host {
namespace {

/// How far a point is outside the view at most, by one of its planes; 0 within.
double outsideOf(const Frustum& view, const glm::dvec3& p_ws)
{
    double outside = 0.0;
    for (const Plane& plane : view.planes) {
        if (plane.normal != glm::dvec3(0.0)) {
            outside = std::max(outside, -plane.distance(p_ws));
        }
    }
    return outside;
}

/// The light that it gives where the camera looks, roughly; 0 where its rays do not come into the view. A camera
/// without a place of its own sees lights in its view equally.
double weightOf(const ShadedLight& light, const Camera& camera, const Frustum& view, const Aabb& scene_ws)
{
    const Light& caster = light.caster;
    if (!(caster.brightness > 0.0)) {
        return 0.0;
    }
    if (caster.type == LightType::directional) {
        return std::numeric_limits<double>::infinity();
    }
    const double outside = outsideOf(view, caster.position_ws);
    if (outside > extentOf(caster, scene_ws).reach_m) {
        return 0.0;
    }
    constexpr double kTooNearToTell = 1e-3; // share of the scene's diagonal
    const double least = kTooNearToTell * glm::length(glm::dvec3(scene_ws.extent()));
    const double away = isOrthographic(camera) ? outside : glm::distance(caster.position_ws, camera.eye_ws);
    return caster.brightness / (away * away + least * least);
}

} // namespace

LightsInSight lightsInSight(std::span<const ShadedLight> lights, const Camera& camera, const Aabb& scene_ws,
                            std::uint32_t first)
{
    LightsInSight out;
    const Frustum view = frustumFromClip(clipFromWorld(camera));
    std::vector<double> weights(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        weights[i] = weightOf(lights[i], camera, view, scene_ws);
        if (weights[i] > 0.0 && i != first) {
            out.lights.push_back(static_cast<std::uint32_t>(i));
        }
    }
    constexpr std::size_t kOthers = kMaxLights - 1;
    if (out.lights.size() > kOthers) {
        out.left_out = out.lights.size() - kOthers;
        std::stable_sort(out.lights.begin(), out.lights.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return weights[a] > weights[b]; });
        out.lights.resize(kOthers);
        std::sort(out.lights.begin(), out.lights.end());
    }
    out.lights.insert(out.lights.begin(), first);
    return out;
}

} // namespace gnomon::host
