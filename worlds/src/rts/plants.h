// SPDX-License-Identifier: Apache-2.0
// Trees, bushes, grass and rocks of the world `rts`; trees stay under some 150 triangles.
#pragma once

#include "palette.h"

#include <cstdint>

namespace gnomon::worlds {

inline constexpr int kTreeVariants = 3;

/// A broad tree of about 7 m. Crown normals point away from the crown's middle, so that cards shade as one body.
[[nodiscard]] Mesh makeBroadTree(const Palette& palette, std::uint32_t variant);
/// A fir of about 9 m.
[[nodiscard]] Mesh makeFir(const Palette& palette, std::uint32_t variant);
[[nodiscard]] Mesh makeBush(const Palette& palette);
[[nodiscard]] Mesh makeGrassTuft(const Palette& palette);
[[nodiscard]] Mesh makeRock(const Palette& palette, std::uint32_t variant);

} // namespace gnomon::worlds
