// SPDX-License-Identifier: Apache-2.0
// The materials of the world `rts`.
#pragma once

#include "../scene_names.h"

namespace gnomon::worlds {

struct Palette {
    std::uint32_t ground = kNone;
    std::uint32_t water = kNone;
    std::uint32_t stone = kNone;
    std::uint32_t wood = kNone;
    std::uint32_t shingle = kNone;
    std::uint32_t thatch = kNone;
    std::uint32_t plain = kNone; // vertex colours alone
    std::uint32_t cloth = kNone; // vertex colours alone, seen from both sides
    std::uint32_t rock = kNone;
    std::uint32_t fire = kNone;
    std::uint32_t crystal = kNone;
    std::uint32_t leaves = kNone; // these three are alpha-masked
    std::uint32_t needles = kNone;
    std::uint32_t grass = kNone;
};

[[nodiscard]] Palette addPalette(Scene& scene);

} // namespace gnomon::worlds
