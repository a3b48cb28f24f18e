// SPDX-License-Identifier: Apache-2.0
#include <gnomon/world_range.h>

#include <glm/common.hpp>

#include <algorithm>

namespace gnomon {

bool isTooFar(const glm::dvec3& place_ws)
{
    const glm::dvec3 size = glm::abs(place_ws);
    return !(size.x <= kFarthestPlace_m && size.y <= kFarthestPlace_m && size.z <= kFarthestPlace_m);
}

std::string_view rangeFault(const Aabb& scene_ws)
{
    if (scene_ws.empty()) {
        return {};
    }
    const glm::dvec3 low(scene_ws.min);
    const glm::dvec3 high(scene_ws.max);
    if (isTooFar(low) || isTooFar(high)) {
        return "the scene reaches farther than 1e9 m from the origin";
    }
    const glm::dvec3 edges = high - low;
    const glm::dvec3 reach = glm::max(glm::abs(low), glm::abs(high));
    const double longest_m = std::max({edges.x, edges.y, edges.z});
    if (longest_m == 0.0) {
        return {};
    }
    if (!(longest_m >= kSmallestScene_m)) {
        return "the scene is smaller than 1e-6 m";
    }
    if (!(longest_m >= kSmallestShare * std::max({reach.x, reach.y, reach.z}))) {
        return "the scene is smaller than 1/100000 of its distance from the origin";
    }
    return {};
}

} // namespace gnomon
