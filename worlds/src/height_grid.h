// SPDX-License-Identifier: Apache-2.0
// Ground as heights on a square grid about the origin, and the triangles drawn from it.
#pragma once

#include "scene_names.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon::worlds {

class HeightGrid {
public:
    static constexpr std::int32_t kChunkCells = 16;

    /// `cells` on a side, a multiple of kChunkCells. All heights are 0.
    HeightGrid(std::int32_t cells, float size_m);

    [[nodiscard]] std::int32_t cells() const { return cells_; }
    [[nodiscard]] float cellsPerM() const { return cells_per_m_; }
    /// The index of a corner of cells in `heights`, and in other data that is kept by corner.
    [[nodiscard]] std::size_t index(std::int32_t ix, std::int32_t iz) const
    {
        return static_cast<std::size_t>(iz * side_ + ix);
    }
    [[nodiscard]] glm::vec2 point(std::int32_t ix, std::int32_t iz) const
    {
        return glm::vec2(static_cast<float>(ix), static_cast<float>(iz)) / cells_per_m_ - size_m_ * 0.5F;
    }
    /// A coordinate in metres as one in cells, from 0 to just below the last.
    [[nodiscard]] float toCells(float metres) const
    {
        return std::clamp((metres + size_m_ * 0.5F) * cells_per_m_, 0.0F, static_cast<float>(cells_) - 0.001F);
    }
    /// The height of a corner; beyond the border that of the border.
    [[nodiscard]] float at(std::int32_t ix, std::int32_t iz) const
    {
        return heights[index(std::clamp(ix, 0, cells_), std::clamp(iz, 0, cells_))];
    }
    /// Height of the drawn triangles at x, z; beyond the border that of the border.
    [[nodiscard]] float height(float x, float z) const
    {
        const float gx = toCells(x);
        const float gz = toCells(z);
        const auto ix = static_cast<std::int32_t>(gx);
        const auto iz = static_cast<std::int32_t>(gz);
        const float fx = gx - static_cast<float>(ix);
        const float fz = gz - static_cast<float>(iz);
        const float* h = &heights[index(ix, iz)];
        const float* next = h + side_;
        // The diagonal runs from (1, 0) to (0, 1), as chunk() draws it.
        return fx + fz <= 1.0F ? h[0] + (h[1] - h[0]) * fx + (next[0] - h[0]) * fz
                               : next[1] + (next[0] - next[1]) * (1.0F - fx) + (h[1] - next[1]) * (1.0F - fz);
    }
    [[nodiscard]] glm::vec3 normal(std::int32_t ix, std::int32_t iz) const;
    /// The cells from kChunkCells times (cx, cz) on. The detail image spans `image_m` metres.
    [[nodiscard]] Primitive chunk(std::int32_t cx, std::int32_t cz, float image_m,
                                  const std::function<glm::vec4(std::int32_t ix, std::int32_t iz)>& colour) const;

    std::vector<float> heights; // metres, by index()

private:
    std::int32_t cells_;
    std::int32_t side_;
    float size_m_;
    float cells_per_m_;
};

} // namespace gnomon::worlds
