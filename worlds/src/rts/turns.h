// SPDX-License-Identifier: Apache-2.0
// Turns of limbs and bodies, by square roots alone, so that every machine has the same.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::worlds {

/// A small turn about +x; exact enough below one radian.
[[nodiscard]] inline glm::quat aboutX(float angle_rad)
{
    const float h = angle_rad * 0.5F;
    const float s = h - h * h * h * (1.0F / 6.0F);
    return {std::sqrt(1.0F - s * s), s, 0.0F, 0.0F};
}

/// Turn about +y that takes +z to `direction` (x, z).
[[nodiscard]] inline glm::quat heading(const glm::vec2& direction)
{
    const float c = std::sqrt(std::max(0.0F, 0.5F * (1.0F + direction.y)));
    const float s = std::sqrt(std::max(0.0F, 0.5F * (1.0F - direction.y)));
    return {c, 0.0F, direction.x < 0.0F ? -s : s, 0.0F};
}

} // namespace gnomon::worlds
