// SPDX-License-Identifier: Apache-2.0
// Shapes bent around the ring of the world `ring`. Along the ring they are given in tiles (RingWorld).
#pragma once

#include "../scene_names.h"
#include "worlds/ring.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <string>

namespace gnomon::worlds {

/// The transform of a thing upright on the deck: +x is along the ring, +y up, +z across. `yaw_rad` turns about up.
[[nodiscard]] Transform onRing(double tiles, double across_m, float yaw_rad = 0.0F, double height_m = 0.0,
                               float scale = 1.0F);

struct BentVertex {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F, 1.0F, 0.0F};
    glm::vec2 uv{0.0F};
    glm::vec4 colour{1.0F};
};

/// The colours of a bent box: its two long sides, towards -z and +z or, where it stands across the ring, towards
/// smaller and larger tiles; and all other sides.
struct BentPaint {
    glm::vec4 low{1.0F};
    glm::vec4 high{1.0F};
    glm::vec4 edges{1.0F};
};
struct Extent {
    double from = 0.0;
    double to = 0.0;
};
/// Along in tiles, height and across in metres.
struct BentExtents {
    Extent tiles;
    Extent height_m;
    Extent across_m;
};

/// Triangles in world space. A point depends on its own coordinates alone, so that pieces that share a border have the
/// same numbers there.
class BentPart {
public:
    /// `at(u, v)` is the vertex at [0, 1] x [0, 1]. Triangles face the way their normals point.
    template <typename At>
    void patch(int columns, int rows, At at)
    {
        const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
        for (int row = 0; row <= rows; ++row) {
            for (int column = 0; column <= columns; ++column) {
                add(at(static_cast<double>(column) / columns, static_cast<double>(row) / rows));
            }
        }
        connect(first, static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
    }
    /// All six sides; `pieces` along the ring, so that it follows the bend.
    void box(const BentExtents& extents, const BentPaint& paint, int pieces = 2);

    [[nodiscard]] Mesh take(const std::string& name, std::uint32_t material);

private:
    void add(const BentVertex& vertex);
    void connect(std::uint32_t first, std::uint32_t columns, std::uint32_t rows);

    Primitive primitive_;
};

} // namespace gnomon::worlds
