// SPDX-License-Identifier: Apache-2.0
// The materials of the world `ring`, and the colours of its lights.
#pragma once

#include "../rts/palette.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace gnomon::worlds {

enum class Hue : std::uint8_t { warm, amber, white, cyan, rose, violet, lime, red };
inline constexpr std::size_t kHues = 8;

struct RingPalette {
    Palette common;             // plants, wood, cloth (seen from both sides), and plain: vertex colours alone
    std::uint32_t deck = kNone; // plates
    std::uint32_t wall = kNone; // panels; hull and rooms
    std::uint32_t metal = kNone;
    std::uint32_t gloss = kNone;
    std::uint32_t shade = kNone;     // for lamps: lit from within, seen from both sides
    std::uint32_t pane_warm = kNone; // these two glow a little
    std::uint32_t pane_cold = kNone;
    std::array<std::uint32_t, kHues> glow{}; // for bulbs
    std::array<std::uint32_t, kHues> neon{}; // for signs and screens: less, so that its colour shows

    [[nodiscard]] std::uint32_t neonOf(Hue hue) const { return neon[static_cast<std::size_t>(hue)]; }
};
[[nodiscard]] RingPalette addRingPalette(Scene& scene);

/// Linear, of luminance 1.
[[nodiscard]] glm::vec3 colourOf(Hue hue);

} // namespace gnomon::worlds
