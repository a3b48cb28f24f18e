// SPDX-License-Identifier: Apache-2.0
// The things on the stage of the world `spotlit`. They stand on y = 0 around the origin.
#pragma once

#include "scene_names.h"

namespace gnomon::worlds {

struct StagePalette {
    std::uint32_t floor = kNone;
    std::uint32_t wall = kNone;
    std::uint32_t marble = kNone; // Phong, as are bronze, glaze, lacquer and brass
    std::uint32_t bronze = kNone;
    std::uint32_t glaze = kNone;
    std::uint32_t lacquer = kNone;
    std::uint32_t brass = kNone;
    std::uint32_t pearl = kNone;
    std::uint32_t wood = kNone;
    std::uint32_t iron = kNone;
    std::uint32_t glow = kNone;
};

/// Up to the capital's top at `height_m`.
[[nodiscard]] Mesh makeColumn(const StagePalette& palette, float height_m);
/// A half circle over `span_m` along x, springing from y = 0.
[[nodiscard]] Mesh makeArch(const StagePalette& palette, float span_m);
[[nodiscard]] Mesh makePedestal(const StagePalette& palette, float half_width_m, float height_m);
/// A robed figure that holds up a globe, 2.3 m.
[[nodiscard]] Mesh makeFigure(const StagePalette& palette);
[[nodiscard]] Mesh makeTeapot(const StagePalette& palette);
[[nodiscard]] Mesh makeUrn(const StagePalette& palette);
[[nodiscard]] Mesh makeChessPiece(const StagePalette& palette);
[[nodiscard]] Mesh makeCrateStack(const StagePalette& palette);
/// About the z axis, centred on the origin.
[[nodiscard]] Mesh makeRing(const StagePalette& palette, float radius_m, float thickness_m);
/// A can around a light at the origin that shines down -z.
[[nodiscard]] Mesh makeLampHousing(const StagePalette& palette);

} // namespace gnomon::worlds
