// SPDX-License-Identifier: Apache-2.0
// The map of the world `rts`: a height field with a camp, a river, a lake, mesas and trodden roads.
#pragma once

#include "loops.h"

#include "scene/model.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::scene::worlds {

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
    [[nodiscard]] float height(float x, float z) const
    {
        const float gx = clampToGrid((x + kMapSize_m * 0.5F) * kCellsPerM);
        const float gz = clampToGrid((z + kMapSize_m * 0.5F) * kCellsPerM);
        const auto ix = static_cast<std::int32_t>(gx);
        const auto iz = static_cast<std::int32_t>(gz);
        const float fx = gx - static_cast<float>(ix);
        const float fz = gz - static_cast<float>(iz);
        const float* h = &heights_[static_cast<std::size_t>(iz * kSide + ix)];
        // The diagonal runs from (1, 0) to (0, 1), as addTo() draws it.
        return fx + fz <= 1.0F
                   ? h[0] + (h[1] - h[0]) * fx + (h[kSide] - h[0]) * fz
                   : h[kSide + 1] + (h[kSide] - h[kSide + 1]) * (1.0F - fx) + (h[1] - h[kSide + 1]) * (1.0F - fz);
    }
    [[nodiscard]] glm::vec3 ground(glm::vec2 xz) const { return {xz.x, height(xz.x, xz.y), xz.y}; }
    /// Rise over run of the steepest way at a point.
    [[nodiscard]] float slope(float x, float z) const;
    /// 1 on a road, 0 away from all.
    [[nodiscard]] float road(float x, float z) const;

    /// Chunks of 16 by 16 cells, the water, and the cut through the earth at the border.
    void addTo(Scene& scene, std::uint32_t ground_material, std::uint32_t water_material) const;

private:
    static constexpr std::int32_t kCells = 256;
    static constexpr std::int32_t kSide = kCells + 1;
    static constexpr std::int32_t kChunkCells = 16;
    static constexpr float kCellsPerM = static_cast<float>(kCells) / kMapSize_m;

    static float clampToGrid(float g)
    {
        constexpr float kLast = static_cast<float>(kCells) - 0.001F;
        return g > 0.0F ? (g < kLast ? g : kLast) : 0.0F;
    }
    [[nodiscard]] static glm::vec2 gridPoint(std::int32_t ix, std::int32_t iz);
    [[nodiscard]] float heightAt(std::int32_t ix, std::int32_t iz) const;
    [[nodiscard]] float naturalHeight(glm::vec2 p) const;
    void treadRoads(std::span<const Loop> roads);
    void treadRoad(const Loop& road, std::vector<float>& nearest_m, std::vector<float>& road_heights) const;
    [[nodiscard]] glm::vec3 normal(std::int32_t ix, std::int32_t iz) const;
    [[nodiscard]] glm::vec4 colour(std::int32_t ix, std::int32_t iz) const;
    [[nodiscard]] Primitive chunk(std::int32_t cx, std::int32_t cz, float& steepest) const;
    [[nodiscard]] Primitive water(std::int32_t cx, std::int32_t cz) const;
    [[nodiscard]] Primitive border() const;

    std::uint32_t noise_seed_;
    std::vector<float> heights_;
    std::vector<float> roads_;
};

} // namespace gnomon::scene::worlds
