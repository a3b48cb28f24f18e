// SPDX-License-Identifier: Apache-2.0
// The ground of the world `sundial`: a shallow bowl of rolling grass with a trodden path, and hills about it.
#pragma once

#include "../height_grid.h"
#include "../rts/loops.h"

#include "../scene_names.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::worlds {

inline constexpr float kMeadowSize_m = 200.0F; // square about the origin
inline constexpr float kOpenRadius_m = 80.0F;  // within which the ground is open; hills rise beyond
inline constexpr float kCourtRadius_m = 5.6F;  // level, about the sundial
inline constexpr glm::vec2 kHouseAt{-25.0F, -17.0F};
inline constexpr float kHouseYaw_rad = 0.7853982F; // its front looks south-east
inline constexpr float kGardenRadius_m = 15.0F;

/// The path: closed, past the house, about the sundial and around the meadow's western half.
[[nodiscard]] Loop makePath();

class Meadow {
public:
    Meadow(std::uint64_t seed, const Loop& path);

    /// Height of the drawn triangles at x, z; beyond the border that of the border.
    [[nodiscard]] float height(float x, float z) const { return grid_.height(x, z); }
    [[nodiscard]] glm::vec3 ground(glm::vec2 xz) const { return {xz.x, height(xz.x, xz.y), xz.y}; }
    [[nodiscard]] glm::vec3 normal(glm::vec2 xz) const;
    /// Metres to the middle of the path; large far away from it.
    [[nodiscard]] float pathDistance(glm::vec2 xz) const;

    /// Square chunks of 20 m.
    void addTo(Scene& scene, std::uint32_t material) const;

private:
    static constexpr std::int32_t kCells = 160;

    [[nodiscard]] float naturalHeight(glm::vec2 p) const;
    [[nodiscard]] glm::vec4 colour(std::int32_t ix, std::int32_t iz) const;

    std::uint32_t noise_seed_;
    HeightGrid grid_;
    std::vector<float> path_m_;
};

/// Where the house's own point (x, z) is, seen from above.
[[nodiscard]] glm::vec2 fromHouse(glm::vec2 own);

} // namespace gnomon::worlds
