// SPDX-License-Identifier: Apache-2.0
#include "light_reach.h"

#include "motion/steps.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gnomon/shared/cascade_fit.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace gnomon {

double lightReach(const Light& light, const LightSpace& space, double near_m, double far_m)
{
    if (!space.perspective) {
        return std::tan(0.5 * light.angular_diameter_rad) * std::max(far_m - near_m, 0.0);
    }
    // From (x / d, d) to the lamp's rim (r, 0): at depth z the ray is at x / d + r (1 / z - 1 / d).
    const double z = std::max(near_m, space.near_m);
    return light.radius_m * std::max(1.0 / z - 1.0 / std::max(far_m, z), 0.0);
}

double affordableReach(double reach, const glm::dvec2& size)
{
    return std::min(reach, shared::kMostRoom * std::max(size.x, size.y));
}

double steadyReach(const Light& light, const LightSpace& space, const Aabb& scene_ws)
{
    const glm::dvec3 size = glm::dvec3(scene_ws.max) - glm::dvec3(scene_ws.min);
    const double reach = space.perspective ? lightReach(light, space, space.near_m, space.reach_m)
                                           : lightReach(light, space, 0.0, glm::dot(glm::abs(space.depth_ws), size));
    return reach > 0.0 ? steppedUp(reach) : 0.0;
}

Aabb reachBox(const Light& light, const Aabb& scene_ws)
{
    if (light.type == LightType::directional || light.range_m <= 0.0) {
        return scene_ws;
    }
    const glm::vec3 range(static_cast<float>(light.range_m));
    const glm::vec3 place(light.position_ws);
    return {glm::max(scene_ws.min, place - range), glm::min(scene_ws.max, place + range)};
}

Outcome widthForPcss(const Light& light, const ObjectSet& objects)
{
    if (light.type == LightType::directional) {
        return light.angular_diameter_rad > kWidestPcssSun_rad ? kTooWideSun : Outcome{};
    }
    bool reaches = false;
    const std::span<const Aabb> bounds = objects.allBounds();
    for (std::uint32_t object = 0; object < bounds.size(); ++object) {
        const Aabb& box = bounds[object];
        if (box.empty() || !objects.flags(object).receives) {
            continue;
        }
        const glm::dvec3 low = light.position_ws - glm::dvec3(box.min);
        const glm::dvec3 high = glm::dvec3(box.max) - light.position_ws;
        const double nearest_m = glm::length(glm::max(glm::max(-low, -high), glm::dvec3(0.0)));
        // A room around the lamp may be as far from it as its corners.
        const double distance_m = nearest_m > 0.0 ? nearest_m : glm::length(glm::max(low, high));
        if (light.range_m == 0.0 || nearest_m <= light.range_m) {
            reaches = true;
            if (light.radius_m <= kWidestPcssLamp * distance_m) {
                return {}; // mostly one of the first
            }
        }
    }
    return reaches && light.radius_m > 0.0 ? kTooWideLamp : Outcome{};
}

} // namespace gnomon
