// SPDX-License-Identifier: Apache-2.0
// Images made by code. All repeat without a seam unless they are foliage or cookies; colour values are sRGB-encoded.
// Surface images are near white on average, so that a vertex colour says what they are made of.
#pragma once

#include "scene_names.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace gnomon::worlds {

/// An image whose texel at uv (centre, in [0,1), v down) is `shade(uv)`, RGBA in [0, 1].
template <typename Shade>
[[nodiscard]] Image paint(const std::string& name, std::uint32_t side, Shade shade)
{
    Image image;
    image.name = name;
    image.width = image.height = side;
    image.rgba.resize(static_cast<std::size_t>(side) * side * 4);
    std::uint8_t* out = image.rgba.data();
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const glm::vec4 c = shade(glm::vec2((static_cast<float>(x) + 0.5F) / static_cast<float>(side),
                                                (static_cast<float>(y) + 0.5F) / static_cast<float>(side)));
            for (int k = 0; k < 4; ++k) {
                *out++ = static_cast<std::uint8_t>(std::lround(std::clamp(c[k], 0.0F, 1.0F) * 255.0F));
            }
        }
    }
    return image;
}

[[nodiscard]] Image rulerTiles();   // 4 x 4 tiles with fine lines at tenths
[[nodiscard]] Image groundDetail(); // blades, clods and pebbles
[[nodiscard]] Image stoneBlocks();  // coursed masonry, 8 courses
[[nodiscard]] Image planks();       // 6 boards along v
[[nodiscard]] Image shingles();     // 8 rows
[[nodiscard]] Image straw();        // strands along v
[[nodiscard]] Image leafCluster();  // RGBA, broad leaves around the middle
[[nodiscard]] Image needleBranch(); // RGBA, a drooping fir bough, stem at the top
[[nodiscard]] Image grassTuft();    // RGBA, blades from the bottom edge
[[nodiscard]] Image marbleTiles();  // 4 x 4 floor tiles in two tones
[[nodiscard]] Image marbleTileNormals();
[[nodiscard]] Image plaster();
[[nodiscard]] Image windowCookie();  // a tall mullioned window
[[nodiscard]] Image foliageCookie(); // light through leaves
[[nodiscard]] Image gearCookie();    // rings, teeth and a star

} // namespace gnomon::worlds
