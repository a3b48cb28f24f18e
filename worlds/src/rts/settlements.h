// SPDX-License-Identifier: Apache-2.0
// The places of buildings and the things between them.
#pragma once

#include "crowds.h"
#include "palette.h"
#include "terrain.h"

#include <vector>

namespace gnomon::worlds {

inline constexpr std::uint32_t kBuildings = 60;

/// Adds the camp, its palisade, two villages and single buildings. Returns the ground that they take.
std::vector<Site> addSettlements(Scene& scene, const Palette& palette, const Terrain& terrain, Turners& turners);

} // namespace gnomon::worlds
