// SPDX-License-Identifier: Apache-2.0
// Where the buildings and the things between them stand.
#pragma once

#include "crowds.h"
#include "palette.h"
#include "terrain.h"

#include <vector>

namespace gnomon::worlds {

inline constexpr std::uint32_t kBuildings = 60;

/// Adds the camp, its palisade, two villages and what stands alone. Returns the ground that is taken.
std::vector<Site> addSettlements(Scene& scene, const Palette& palette, const Terrain& terrain, Turners& turners);

} // namespace gnomon::worlds
