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
    /// Channels of a tile: 4 or 8; the mask has a layer for every four. 0: the mask is not compact, and every light has
    /// a channel.
    std::uint32_t channels = 0;
    std::uint32_t side_px = 16; // side of a tile, 16 or 32. Smaller tiles come nearer to a full mask, with longer lists

    bool operator==(const CompactMaskRule&) const = default;
};
/// The fault of a rule, as static text; null for a sound one.
[[nodiscard]] GNOMON_API const char* wrongOf(const CompactMaskRule& rule);

inline constexpr std::uint32_t kNoMaskChannel = 0xFF; // the channel of a light without a map: it reads 1
/// A light's number has 24 bits in fillMaskTiles(), and a tile's count of lights has 16.
inline constexpr std::uint32_t kMostTileLights = 0xFFFF;

/// A light of a tile.
struct TileLight {
    std::uint32_t light = 0;   // index into Frame::lights
    std::uint32_t channel = 0; // in the tile: layer * 4 + channel of the mask; or kNoMaskChannel
    /// The light's weight in its channel: 1 in a channel of its own. Weights of lights that share a channel add up to
    /// 1.
    float weight = 1.0F;

    bool operator==(const TileLight&) const = default;
};

/// Which lights each tile has, and in which channels their shadows are.
struct CompactMask {
    CompactMaskRule rule; // the rule that it was made by
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
/// all others share the last channel. Importance is Light::brightness times its fall-off at the point nearest to the
/// light on the line of sight through the tile's middle; it does not change within an eighth of the light's reach.
/// Among equals the first light in the frame wins. Weights in the last channel are proportional to importance.
/// `size_px`: size of the mask. `lists`: scratch. Both it and `out` keep their memory. Linear in entries. A number that
/// is not finite counts as 0. Throws Error for a rule that is wrong, more than kMostTileLights lights, or a frame with
/// others than the plan.
GNOMON_API void listCompactMask(const Plan& plan, const CompactMaskRule& rule, glm::uvec2 size_px, LightLists& lists,
                                CompactMask& out);

/// The draws of a compact mask: for each layer one draw for each of the plan's options that has lights with maps, all
/// over the screen. In them MaskDraw::first_light is the layer and `channels` the options. Draws that share a layer
/// each subtract the light that their own lights lose from the mask, which is 1 at first. Keeps the memory of `out`.
GNOMON_API void listCompactMaskDraws(const Plan& plan, const CompactMaskRule& rule, glm::uvec2 size_px,
                                     std::vector<MaskDraw>& out);

/// How many words fillMaskTiles() writes.
[[nodiscard]] GNOMON_API std::size_t maskTileWords(const CompactMask& mask);
/// Writes the words that shaders/include/gnomon/compact_mask.glsl reads: the side and the tiles along x; for each tile
/// the word of its first light, and lights with channels | all its lights << 16; for each light its number | channel <<
/// 24, and its weight. Throws Error where there is no room for that.
GNOMON_API void fillMaskTiles(const CompactMask& mask, std::span<glm::uvec2> words);

} // namespace gnomon::pack
