// SPDX-License-Identifier: Apache-2.0
// Three roofs over each other: a pergola of slats, a sail and an awning. A sun, "sun", and a spot light, "spot". Views
// `roofs`, `side` and `top`. The seed changes nothing.
#pragma once

#include <glm/vec3.hpp>

namespace gnomon::worlds {

/// Exact geometry of the world `canopies`: flat roofs at three heights, one over the other, above the plane y = 0.
/// Where a border of a higher roof crosses a lower one, seen from the light, the ground below both is in full shadow,
/// and a map holds both heights side by side there: this is where filters that store averages let light through (light
/// bleeding). Seen along the sun, every roof is farther from the light than all of the roofs above it and nearer than
/// all of the ground, so that planes between them can part them.
struct CanopiesWorld {
    struct Box {
        glm::vec3 min{0.0F};
        glm::vec3 max{0.0F};
    };
    struct Rectangle { // a part of the ground
        float min_x = 0.0F;
        float min_z = 0.0F;
        float max_x = 0.0F;
        float max_z = 0.0F;

        [[nodiscard]] constexpr bool holds(float x, float z) const
        {
            return x > min_x && x < max_x && z > min_z && z < max_z;
        }
    };
    static constexpr float ground_half_size_m = 10.0F;
    static constexpr int slats = 6; // slats of the pergola, the highest roof, side by side along x
    static constexpr Box sail{{-6.4F, 7.0F, -4.4F}, {-0.6F, 7.1F, 2.2F}};
    static constexpr Box awning{{-2.2F, 2.5F, -1.1F}, {5.2F, 2.6F, 3.3F}}; // the lowest
    /// The way sunlight travels, before normalisation: a point at height h throws its shadow 0.02 h along +x and 0.12 h
    /// along +z.
    static constexpr glm::vec3 sun_direction{0.02F, -1.0F, 0.12F};
    /// The most, in x or z, that the sun's disc, 0.53 degrees wide, adds to a shadow's offset: 0.005 h.
    static constexpr float sun_spread = 0.005F;
    static constexpr glm::vec3 spot_position{1.0F, 30.0F, 2.0F};
    static constexpr glm::vec3 spot_target{-0.5F, 0.0F, 0.0F};

    [[nodiscard]] static constexpr Box slat(int i)
    {
        const float x = 2.0F * static_cast<float>(i) - 5.6F;
        return {{x, 18.0F, -5.0F}, {x + 1.2F, 18.15F, 5.0F}};
    }
    /// The points of the ground that `roof` alone shades fully.
    [[nodiscard]] static constexpr Rectangle umbraOf(const Box& roof)
    {
        const float h = roof.min.y;
        return {roof.min.x + (sun_direction.x + sun_spread) * h, roof.min.z + (sun_direction.z + sun_spread) * h,
                roof.max.x + (sun_direction.x - sun_spread) * h, roof.max.z + (sun_direction.z - sun_spread) * h};
    }
    /// The points of the ground outside which `roof` shades nothing.
    [[nodiscard]] static constexpr Rectangle reachOf(const Box& roof)
    {
        return {roof.min.x + (sun_direction.x - sun_spread) * roof.min.y,
                roof.min.z + (sun_direction.z - sun_spread) * roof.min.y,
                roof.max.x + (sun_direction.x + sun_spread) * roof.max.y,
                roof.max.z + (sun_direction.z + sun_spread) * roof.max.y};
    }
    /// The depth of a point under the sun: metres along the sun's direction from the plane through the origin.
    [[nodiscard]] static constexpr float depthOf(const glm::vec3& point)
    {
        constexpr float kLength = 1.0073728F; // the length of sun_direction
        return (sun_direction.x * point.x + sun_direction.y * point.y + sun_direction.z * point.z) / kLength;
    }
};

} // namespace gnomon::worlds
