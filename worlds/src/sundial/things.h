// SPDX-License-Identifier: Apache-2.0
// The things on the meadow of the world `sundial`. Unless said otherwise a thing stands on y = 0 around the origin.
#pragma once

#include "../rts/palette.h"
#include "meadow.h"

#include <cstdint>
#include <span>

namespace gnomon::worlds {

/// The materials of the world: those of `rts`, and further ones.
struct SundialPalette {
    Palette common;
    std::uint32_t plaster = kNone;
    std::uint32_t pale_stone = kNone; // smooth; the dial's
    std::uint32_t bronze = kNone;
    std::uint32_t flowers = kNone; // alpha-masked
};
[[nodiscard]] SundialPalette addSundialPalette(Scene& scene);

/// Steps, plinth, dial with its hour lines, and the gnomon; see SundialWorld.
[[nodiscard]] Mesh makeDial(const SundialPalette& palette);
/// A stone bench along x.
[[nodiscard]] Mesh makeBench(const SundialPalette& palette);
/// A long house with its ridge along x; an arcade of five bays under a lean-to roof on its +z side.
[[nodiscard]] Mesh makeHouse(const SundialPalette& palette);

inline constexpr std::uint32_t kOakVariants = 2;
/// A spreading tree of about 9 m. `near`: its leaves are to be seen from nearby, in some 900 triangles; otherwise it is
/// one of a wood, in some 300.
[[nodiscard]] Mesh makeOak(const SundialPalette& palette, std::uint32_t variant, bool near);
/// Some blades on a disc of 1.5 m.
[[nodiscard]] Mesh makeGrassPatch(const SundialPalette& palette);
[[nodiscard]] Mesh makeFlowerPatch(const SundialPalette& palette);

/// A fence along `corners` (x, z) on the ground: white pickets on two rails, or posts with three bars. In world space.
[[nodiscard]] Mesh makePickets(const SundialPalette& palette, const Meadow& meadow, std::span<const glm::vec2> corners);
[[nodiscard]] Mesh makeRails(const SundialPalette& palette, const Meadow& meadow, std::span<const glm::vec2> corners);

} // namespace gnomon::worlds
