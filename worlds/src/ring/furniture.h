// SPDX-License-Identifier: Apache-2.0
// The furniture in the rooms of the world `ring`. Each piece stands on y = 0 around the origin, its front towards +z.
// Feet reach a little lower, because the deck is bent and they are not.
#pragma once

#include "palette.h"

namespace gnomon::worlds {

[[nodiscard]] Mesh makeStool(const RingPalette& palette);
[[nodiscard]] Mesh makeTable(const RingPalette& palette);
/// A chair like half an egg.
[[nodiscard]] Mesh makeTubChair(const RingPalette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makeSofa(const RingPalette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makeBottleShelf(const RingPalette& palette);
[[nodiscard]] Mesh makeJukebox(const RingPalette& palette);
/// Two glasses and a shaker.
[[nodiscard]] Mesh makeGlasses(const RingPalette& palette);
[[nodiscard]] Mesh makeBench(const RingPalette& palette);
[[nodiscard]] Mesh makeBed(const RingPalette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makeNightstand(const RingPalette& palette);
[[nodiscard]] Mesh makeLocker(const RingPalette& palette, std::uint32_t srgb);

[[nodiscard]] Mesh makeCrate(const RingPalette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makeDrum(const RingPalette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makeConsole(const RingPalette& palette, Hue screen);
/// A bed under an arch of instruments.
[[nodiscard]] Mesh makeScanner(const RingPalette& palette);
[[nodiscard]] Mesh makeWorkbench(const RingPalette& palette);
/// A turbine on its cradle, 3.6 m along x.
[[nodiscard]] Mesh makeTurbine(const RingPalette& palette);
[[nodiscard]] Mesh makeBoiler(const RingPalette& palette);
[[nodiscard]] Mesh makeStall(const RingPalette& palette, std::uint32_t srgb);
/// Round wares for a stall's counter.
[[nodiscard]] Mesh makeWares(const RingPalette& palette);

[[nodiscard]] Mesh makePlanter(const RingPalette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makePalm(const RingPalette& palette, std::uint32_t variant);
[[nodiscard]] Mesh makeFern(const RingPalette& palette);

} // namespace gnomon::worlds
