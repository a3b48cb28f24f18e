// SPDX-License-Identifier: Apache-2.0
// One box over one plane. Views `box`, `top` (straight down) and `side`. The seed changes nothing.
#pragma once

#include <glm/vec3.hpp>

namespace gnomon::worlds {

/// Exact geometry of the world `planes`: an axis-aligned box that floats over the plane y = ground_y, a sun (the first
/// light, named "sun") and a spot light ("spot"). The world is made from these numbers, so tests can compute where an
/// edge lies.
struct PlanesWorld {
    static constexpr float ground_y = 0.0F;
    static constexpr float ground_half_size_m = 20.0F; // the ground spans [-20, 20] in x and z
    static constexpr glm::vec3 box_min{-1.5F, 2.0F, -1.0F};
    static constexpr glm::vec3 box_max{0.5F, 3.0F, 1.0F};
    /// The way sunlight travels, before normalisation: 4 down for every 3 along +x. A point at height h throws its
    /// shadow exactly 0.75 h further along +x.
    static constexpr glm::vec3 sun_direction{3.0F, -4.0F, 0.0F};
    static constexpr glm::vec3 spot_position{-4.0F, 8.0F, 6.0F};
    static constexpr glm::vec3 spot_target{-0.5F, 0.0F, 0.0F};
    static constexpr float spot_inner_half_angle_rad = 0.45F;
    static constexpr float spot_outer_half_angle_rad = 0.55F;
    static constexpr float spot_range_m = 30.0F;

    /// Where the ray through `point` from `light_position` meets the ground.
    [[nodiscard]] static constexpr glm::vec3 projectFrom(const glm::vec3& light_position, const glm::vec3& point)
    {
        const glm::vec3 ray{point.x - light_position.x, point.y - light_position.y, point.z - light_position.z};
        const float t = (ground_y - light_position.y) / ray.y;
        return {light_position.x + ray.x * t, ground_y, light_position.z + ray.z * t};
    }
    /// Where `point`'s shadow under the sun meets the ground.
    [[nodiscard]] static constexpr glm::vec3 projectAlongSun(const glm::vec3& point)
    {
        const float t = (ground_y - point.y) / sun_direction.y;
        return {point.x + sun_direction.x * t, ground_y, point.z + sun_direction.z * t};
    }
};

} // namespace gnomon::worlds
