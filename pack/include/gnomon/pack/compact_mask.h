// SPDX-License-Identifier: Apache-2.0
// The compact mask: some channels for each tile of the screen instead of one for each light of the frame. Each tile
// gives its channels to the lights that matter most there, and lights that are left share its last one.
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/light_lists.h>
#include <gnomon/plan.h>

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pack {

struct MaskDraw;

/// How a mask is compact.
struct CompactMaskRule {
    /// Of a tile: 4 or 8; the mask has a layer for every four. 0: the mask is not compact, every light has a channel.
    std::uint32_t channels = 0;
    std::uint32_t side_px = 16; // of a tile, 16 or 32. Less is nearer to a mask that is not compact, and longer lists

    bool operator==(const CompactMaskRule&) const = default;
};
/// Null, or what is wrong with it.
[[nodiscard]] GNOMON_API const char* wrongOf(const CompactMaskRule& rule);

inline constexpr std::uint32_t kNoMaskChannel = 0xFF; // of a light without a map: it reads 1
/// A light's number has 24 bits in fillMaskTiles(), and a tile's count of lights has 16.
inline constexpr std::uint32_t kMostTileLights = 0xFFFF;

/// A light of a tile.
struct TileLight {
    std::uint32_t light = 0;   // of Frame::lights
    std::uint32_t channel = 0; // of the tile: layer * 4 + channel of the mask; or kNoMaskChannel
    /// What the light counts for in its channel: 1 in one of its own. Those that share a channel have 1 together.
    float weight = 1.0F;

    bool operator==(const TileLight&) const = default;
};

/// Which lights each tile has, and in which channels their shadows are.
struct CompactMask {
    CompactMaskRule rule; // by which it was made
    glm::uvec2 tiles{0};  // along x and y; those on the right and at the bottom may be cut
    /// Tile i = y * tiles.x + x has lights[first[i]] to lights[first[i + 1] - 1]. Its first masked[i] have a channel,
    /// the most important one first; the others have no map.
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> masked; // by tile
    std::vector<TileLight> lights;     // tile after tile

    /// The lights of a tile. Precondition: there is such a tile.
    [[nodiscard]] std::span<const TileLight> of(std::uint32_t x, std::uint32_t y) const
    {
        const std::size_t i = std::size_t{y} * tiles.x + x;
        return std::span(lights).subspan(first[i], first[i + 1] - first[i]);
    }
};

/// Every light that may reach a pixel of a tile (listLights()) is in the tile's list, whether it casts or not. With at
/// most rule.channels lights that have maps, each has a channel of its own. With more, the most important ones do, and
/// the last channel is shared by all others. Importance: Light::brightness by its fall-off at that point of the line
/// of sight through the tile's middle that is nearest to the light, and the same for all points within an eighth of its
/// reach; among equals the one that comes first in the frame. Weights in the last channel are as importance.
/// `size_px`: of the mask. `lists`: scratch, which keeps what it has allocated, as `out` does. Linear in entries.
/// Numbers that are none count for nothing. Throws Error for a rule that is wrong, more than kMostTileLights lights, or
/// a frame with others than the plan.
GNOMON_API void listCompactMask(const Plan& plan, const CompactMaskRule& rule, glm::uvec2 size_px, LightLists& lists,
                                CompactMask& out);

/// The draws of a compact mask: for each layer one of each of the plan's options that has lights with maps, all over
/// the screen. In them MaskDraw::first_light is the layer and `channels` the options; of draws that share, each takes
/// what its lights do not give from what is there, which is 1 at first. Keeps what `out` has allocated.
GNOMON_API void listCompactMaskDraws(const Plan& plan, const CompactMaskRule& rule, glm::uvec2 size_px,
                                     std::vector<MaskDraw>& out);

/// How many words fillMaskTiles() writes.
[[nodiscard]] GNOMON_API std::size_t maskTileWords(const CompactMask& mask);
/// As shaders/include/gnomon/compact_mask.glsl reads it: the side and the tiles along x; for each tile the word of its
/// first light, and how many have channels | how many there are << 16; for each light its number | channel << 24, and
/// its weight. Throws Error where there is no room for that.
GNOMON_API void fillMaskTiles(const CompactMask& mask, std::span<glm::uvec2> words);

} // namespace gnomon::pack
