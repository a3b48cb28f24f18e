// SPDX-License-Identifier: Apache-2.0
#include "bent.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace gnomon::worlds {

double RingWorld::angleOf(double tiles)
{
    // Whole tiles and binary fractions of them stay exact, so that the last tile meets the first.
    const double once = tiles - tiles_around * std::floor(tiles / tiles_around + 0.5);
    return once * (2.0 * std::numbers::pi / tiles_around);
}

glm::vec3 RingWorld::place(double tiles, double height_m, double across_m)
{
    const double angle = angleOf(tiles);
    const double r = radius_m - height_m;
    return {r * std::sin(angle), radius_m - r * std::cos(angle), across_m};
}

glm::vec3 RingWorld::up(double tiles)
{
    const double angle = angleOf(tiles);
    return {-std::sin(angle), std::cos(angle), 0.0};
}

glm::vec3 RingWorld::along(double tiles)
{
    const double angle = angleOf(tiles);
    return {std::cos(angle), std::sin(angle), 0.0};
}

Transform onRing(double tiles, double across_m, float yaw_rad, double height_m, float scale)
{
    Transform transform;
    transform.translation = RingWorld::place(tiles, height_m, across_m);
    transform.rotation = glm::angleAxis(static_cast<float>(RingWorld::angleOf(tiles)), glm::vec3(0, 0, 1)) *
                         glm::angleAxis(yaw_rad, glm::vec3(0, 1, 0));
    transform.scale = glm::vec3(scale);
    return transform;
}

void BentPart::add(const BentVertex& vertex)
{
    primitive_.positions.push_back(vertex.position);
    primitive_.normals.push_back(vertex.normal);
    primitive_.uv0.push_back(vertex.uv);
    primitive_.colours.push_back(vertex.colour);
}

void BentPart::connect(std::uint32_t first, std::uint32_t columns, std::uint32_t rows)
{
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3& p = primitive_.positions[a];
        const glm::vec3 face = glm::cross(primitive_.positions[b] - p, primitive_.positions[c] - p);
        if (glm::dot(face, primitive_.normals[a]) < 0.0F) {
            std::swap(b, c);
        }
        primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
    };
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = first + row * (columns + 1) + column;
            const std::uint32_t b = a + columns + 1;
            triangle(a, a + 1, b + 1);
            triangle(a, b + 1, b);
        }
    }
}

void BentPart::box(const BentExtents& e, const BentPaint& paint, int pieces)
{
    const auto at = [](const Extent& extent, double share) {
        // Both ends as they were given, so that neighbours have the same.
        return share == 1.0 ? extent.to : extent.from + (extent.to - extent.from) * share;
    };
    const double length_m = (e.tiles.to - e.tiles.from) * RingWorld::tile_m;
    const bool along = length_m > e.across_m.to - e.across_m.from; // else it stands across the ring
    for (const bool high : {false, true}) {
        const glm::vec4& side = high ? paint.high : paint.low;
        const double w = high ? e.across_m.to : e.across_m.from;
        patch(pieces, 1, [&](double u, double v) {
            const double t = at(e.tiles, u);
            const double h = at(e.height_m, v);
            return BentVertex{RingWorld::place(t, h, w),
                              {0.0F, 0.0F, high ? 1.0F : -1.0F},
                              glm::vec2(t, -h / 3.0),
                              along ? side : paint.edges};
        });
        const double h = high ? e.height_m.to : e.height_m.from;
        patch(pieces, 1, [&](double u, double v) {
            const double t = at(e.tiles, u);
            const double z = at(e.across_m, v);
            return BentVertex{RingWorld::place(t, h, z), RingWorld::up(t) * (high ? 1.0F : -1.0F),
                              glm::vec2(t, z * 0.5), paint.edges};
        });
        const double t = high ? e.tiles.to : e.tiles.from;
        patch(1, 1, [&](double u, double v) {
            const double z = at(e.across_m, u);
            const double y = at(e.height_m, v);
            return BentVertex{RingWorld::place(t, y, z), RingWorld::along(t) * (high ? 1.0F : -1.0F),
                              glm::vec2(z * 0.5, -y / 3.0), along ? paint.edges : side};
        });
    }
}

Mesh BentPart::take(const std::string& name, std::uint32_t material)
{
    primitive_.material = material;
    Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive_));
    primitive_ = {};
    return mesh;
}

} // namespace gnomon::worlds
