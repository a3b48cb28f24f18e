// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/volume_draws.h>

#include "reach_cells.h"

#include <gnomon/error.h>
#include <gnomon/plan_views.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon::pack {
namespace {

/// Bounds depth by the cube around a lamp's reach: its corners have the least and the most depth, as depth is monotone
/// along the view. A cube that reaches behind the eye begins at the near plane.
void boundDepths(const Light& light, const Aabb& scene_ws, const Camera& camera, VolumeDraw& draw)
{
    if (light.type == LightType::directional || scene_ws.empty()) {
        return;
    }
    const double reach_m = extentOf(light, scene_ws).reach_m;
    double least = 1.0;
    double most = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                              (corner & 4) != 0 ? 1.0 : -1.0);
        const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(light.position_ws + side * reach_m, 1.0);
        const double nearest = camera.reversed_z ? 1.0 : 0.0;
        const double depth = clip.w > 0.0 ? std::clamp(clip.z / clip.w, 0.0, 1.0) : nearest;
        least = std::min(least, depth);
        most = std::max(most, depth);
    }
    constexpr double kRounding = 1e-6; // relative error of a float
    draw.least_depth = static_cast<float>(least * (1.0 - kRounding));
    draw.most_depth = static_cast<float>(std::min(most * (1.0 + kRounding), 1.0));
}

} // namespace

void listVolumeDraws(const Plan& plan, glm::uvec2 size_px, std::vector<VolumeDraw>& out)
{
    out.clear();
    const PlannedFrame& from = plan.made_for;
    if (from.lights.size() != plan.lights.size()) {
        throw Error("list the lights whose shadow volumes are counted",
                    "the plan does not say what they are (Plan::made_for)");
    }
    for (std::uint32_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& planned = plan.lights[i];
        const Light& light = from.lights[i];
        VolumeDraw draw;
        draw.pixels = litPixels(light, from.camera, from.scene_ws, size_px);
        if (planned.volume_count == 0 || draw.pixels.empty()) {
            continue;
        }
        draw.light = i;
        draw.layer = planned.mask_layer;
        draw.channels = maskChannelsOf(planned);
        draw.place = light.type == LightType::directional
                         ? glm::vec4(glm::vec3(-glm::normalize(light.direction_ws)), 0.0F)
                         : glm::vec4(glm::vec3(light.position_ws - from.camera.eye_ws), 1.0F);
        boundDepths(light, from.scene_ws, from.camera, draw);
        out.push_back(draw);
    }
}

} // namespace gnomon::pack
