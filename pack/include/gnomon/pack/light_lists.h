// SPDX-License-Identifier: Apache-2.0
// Which lights may reach what is seen in each tile of the screen: for hosts that shade with many lights.
// Based on: O. Olsson, U. Assarsson, "Tiled Shading", Journal of Graphics, GPU, and Game Tools, 2011.
#pragma once

#include <gnomon/export.h>
#include <gnomon/frame.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pack {

/// Pixels [x0, x1) x [y0, y1) of the picture.
struct ScreenBounds {
    std::uint32_t x0 = 0; // first column
    std::uint32_t y0 = 0; // first row
    std::uint32_t x1 = 0; // one past the last column
    std::uint32_t y1 = 0; // one past the last row

    /// There is no pixel in it.
    [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }

    bool operator==(const ScreenBounds&) const = default;
};

/// Bounds of every pixel that may show a point in the light's reach: all of the picture for a directional light, the
/// bounds of the cone for a spot, and those of a cube around its sphere for a point light. A pixel's width is added on
/// all sides. `extent`: extentOf() the light. A light whose numbers are not finite has all of the picture.
[[nodiscard]] GNOMON_API ScreenBounds screenBounds(const Light& light, const LightExtent& extent, const Camera& camera,
                                                   glm::uvec2 size_px);

/// The lights of each tile, as two arrays that a storage buffer can take as they are.
struct LightLists {
    std::uint32_t side_px = 0; // side of a tile
    glm::uvec2 tiles{0};       // along x and y; those on the right and at the bottom may be cut
    /// Tile (x, y) has lights[first[i]] to lights[first[i + 1] - 1], i = y * tiles.x + x: indices into `lights`,
    /// ascending.
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> lights; // tile after tile

    /// The lights of a tile. Precondition: there is such a tile.
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t x, std::uint32_t y) const
    {
        const std::size_t i = std::size_t{y} * tiles.x + x;
        return std::span(lights).subspan(first[i], first[i + 1] - first[i]);
    }
};

/// Lists all lights, whether or not they cast, in a picture of this size. `scene_bounds_ws`: the bounds of all objects,
/// for lights without a range (extentOf()). Keeps the memory of `out`. There are no tiles where the picture or a tile
/// has size 0.
GNOMON_API void listLights(std::span<const Light> lights, const Camera& camera, const Aabb& scene_bounds_ws,
                           glm::uvec2 size_px, std::uint32_t side_px, LightLists& out);

} // namespace gnomon::pack
