// SPDX-License-Identifier: Apache-2.0
// Groves, rocks and grass over the map, as instances of a few meshes.
#pragma once

#include "palette.h"
#include "terrain.h"

#include <cstdint>
#include <span>

namespace gnomon::worlds {

inline constexpr std::uint32_t kTrees = 400;

void addWilds(Scene& scene, const Palette& palette, const Terrain& terrain, std::span<const Site> taken,
              std::uint64_t seed);

} // namespace gnomon::worlds
