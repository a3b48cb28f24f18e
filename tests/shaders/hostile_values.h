// SPDX-License-Identifier: Apache-2.0
// Numbers that no encoder writes.
#pragma once

#include <glm/glm.hpp>

#include <bit>
#include <cstdint>
#include <iterator>
#include <limits>

namespace gnomon::test {

inline std::uint32_t hostile_state = 1;
inline bool hostile_same = false;

/// The `i`th channel of what the map holds: what is not a number, infinite, huge, negative, denormal, or any bits.
inline float hostileValue(std::uint32_t key, std::uint32_t i)
{
    std::uint32_t h = (key + i * 0x9E3779B9U) * 0x85EBCA6BU; // spread, so that neighbours have nothing in common
    h = (h ^ (h >> 13)) * 0xC2B2AE35U;
    h ^= h >> 16;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kOdd[] = {std::numeric_limits<float>::quiet_NaN(),
                              kInfinity,
                              -kInfinity,
                              3.4e38F,
                              -3.4e38F,
                              1e-40F,
                              -1e-40F,
                              0.0F,
                              -0.0F,
                              1.0F,
                              -1.0F,
                              0.5F,
                              65504.0F,
                              1e19F,
                              1e-20F};
    const std::uint32_t kind = h % 20;
    return kind < std::size(kOdd) ? kOdd[kind] : std::bit_cast<float>(h * 0x27D4EB2FU);
}
inline glm::vec4 hostileTexel()
{
    const std::uint32_t key = hostile_same ? hostile_state : hostile_state++;
    return {hostileValue(key, 0), hostileValue(key, 1), hostileValue(key, 2), hostileValue(key, 3)};
}

} // namespace gnomon::test
