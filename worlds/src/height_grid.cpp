// SPDX-License-Identifier: Apache-2.0
#include "height_grid.h"

#include <glm/geometric.hpp>

namespace gnomon::worlds {

HeightGrid::HeightGrid(std::int32_t cells, float size_m)
    : heights(static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 1)), cells_(cells),
      side_(cells + 1), size_m_(size_m), cells_per_m_(static_cast<float>(cells) / size_m)
{
}

glm::vec3 HeightGrid::normal(std::int32_t ix, std::int32_t iz) const
{
    const float dx = (at(ix + 1, iz) - at(ix - 1, iz)) * cells_per_m_ * 0.5F;
    const float dz = (at(ix, iz + 1) - at(ix, iz - 1)) * cells_per_m_ * 0.5F;
    return glm::normalize(glm::vec3(-dx, 1.0F, -dz));
}

Primitive HeightGrid::chunk(std::int32_t cx, std::int32_t cz, float image_m,
                            const std::function<glm::vec4(std::int32_t ix, std::int32_t iz)>& colour) const
{
    Primitive primitive;
    constexpr std::int32_t kVertices = kChunkCells + 1;
    for (std::int32_t j = 0; j < kVertices; ++j) {
        for (std::int32_t i = 0; i < kVertices; ++i) {
            const std::int32_t ix = cx * kChunkCells + i;
            const std::int32_t iz = cz * kChunkCells + j;
            const glm::vec2 p = point(ix, iz);
            primitive.positions.emplace_back(p.x, at(ix, iz), p.y);
            primitive.normals.push_back(normal(ix, iz));
            primitive.colours.push_back(colour(ix, iz));
            primitive.uv0.emplace_back(p / image_m);
        }
    }
    for (std::int32_t j = 0; j < kChunkCells; ++j) {
        for (std::int32_t i = 0; i < kChunkCells; ++i) {
            const auto a = static_cast<std::uint32_t>(j * kVertices + i);
            const std::uint32_t b = a + 1;
            const std::uint32_t c = a + kVertices;
            primitive.indices.insert(primitive.indices.end(), {a, c, b, b, c, c + 1});
        }
    }
    return primitive;
}

} // namespace gnomon::worlds
