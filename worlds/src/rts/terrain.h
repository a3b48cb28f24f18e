// SPDX-License-Identifier: Apache-2.0
// The map of the world `rts`: a height field with a camp, a river, a lake, mesas and trodden roads.
#pragma once

#include "../height_grid.h"
#include "loops.h"

#include "../scene_names.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::worlds {

inline constexpr float kMapSize_m = 512.0F; // square about the origin
inline constexpr float kWaterLevel_m = 4.0F;
inline constexpr float kCampHeight_m = 8.0F;
inline constexpr float kCampRadius_m = 52.0F;

/// A place kept flat for buildings.
struct Site {
    glm::vec2 centre{0.0F};
    float radius_m = 20.0F;
};
[[nodiscard]] std::span<const Site> villageSites();

class Terrain {
public:
    Terrain(std::uint64_t seed, std::span<const Loop> roads);

    /// Height of the drawn triangles at x, z; beyond the border that of the border.
    [[nodiscard]] float height(float x, float z) const { return grid_.height(x, z); }
    [[nodiscard]] glm::vec3 ground(glm::vec2 xz) const { return {xz.x, height(xz.x, xz.y), xz.y}; }
    /// Rise over run of the steepest way at a point.
    [[nodiscard]] float slope(float x, float z) const;
    /// 1 on a road, 0 away from all.
    [[nodiscard]] float road(float x, float z) const;

    /// Chunks of 16 by 16 cells, the water, and the cut through the earth at the border.
    void addTo(Scene& scene, std::uint32_t ground_material, std::uint32_t water_material) const;

private:
    static constexpr std::int32_t kCells = 256;
    static constexpr std::int32_t kChunkCells = HeightGrid::kChunkCells;

    [[nodiscard]] float naturalHeight(glm::vec2 p) const;
    void treadRoads(std::span<const Loop> roads);
    void treadRoad(const Loop& road, std::vector<float>& nearest_m, std::vector<float>& road_heights) const;
    [[nodiscard]] glm::vec4 colour(std::int32_t ix, std::int32_t iz) const;
    [[nodiscard]] Primitive water(std::int32_t cx, std::int32_t cz) const;
    [[nodiscard]] Primitive border() const;

    std::uint32_t noise_seed_;
    HeightGrid grid_;
    std::vector<float> roads_;
};

} // namespace gnomon::worlds
