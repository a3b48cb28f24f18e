// SPDX-License-Identifier: Apache-2.0
// The casters that can shade what is seen, for filters that draw no maps of them.
#include "frustum_planner.h"

#include "light_reach.h"

#include <glm/common.hpp>

#include <limits>

namespace gnomon {

Outcome FrustumPlanner::listCasters(const FrustumInput& input, std::vector<std::uint32_t>& casters)
{
    if (layoutOf(input.light) == LightType::point) {
        return listCastersAround(input, casters);
    }
    const LightSpace space =
        lightSpaceOf(input.light, input.slice.axis_ws, input.slice.half_angle_rad, input.camera.scene_ws);
    const RegionInput around{space,           input.slice, input.camera,      *input.frame.objects,
                             input.receivers, false,       input.light.groups};
    if (const Outcome seen = region_.gatherReceivers(around); seen.kind != OutcomeKind::ok) {
        return seen;
    }
    const CasterReach reach{region_.rect(), 0.0, farthestCaster(region_, space, false, input.camera.pad_m), false};
    return region_.gatherCasters(around, reach, casters);
}

/// Between the light and what is seen in its reach: all in the box around both.
Outcome FrustumPlanner::listCastersAround(const FrustumInput& input, std::vector<std::uint32_t>& casters)
{
    const Aabb reach = grown(reachBox(input.light, input.camera.scene_ws), input.camera.pad_m);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const std::uint32_t object : input.receivers) {
        const Aabb box = input.frame.objects->bounds(object);
        low = glm::min(low, glm::max(glm::dvec3(box.min), glm::dvec3(reach.min)));
        high = glm::max(high, glm::min(glm::dvec3(box.max), glm::dvec3(reach.max)));
    }
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) {
        return {OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
    }
    low = glm::min(low, input.light.position_ws);
    high = glm::max(high, input.light.position_ws);
    planes_.clear();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        planes_.push_back({normal, input.camera.pad_m - low[axis]});
        planes_.push_back({-normal, input.camera.pad_m + high[axis]});
    }
    const std::size_t first = casters.size();
    input.frame.objects->query(planes_, ObjectSet::Want::casters, casters, input.light.groups);
    return casters.size() == first
               ? Outcome{OutcomeKind::no_caster, "nothing can throw a shadow on what the camera sees"}
               : Outcome{};
}

} // namespace gnomon
