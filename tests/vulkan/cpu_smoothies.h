// SPDX-License-Identifier: Apache-2.0
// The smoothies beside a map, computed texel by texel on the CPU.
#pragma once

#include "cpu_map.h"

#include <gnomon/plan.h>

#include <vector>

namespace gnomon::test {

/// The smoothies of a tile's texels, row by row, packed as in gnomon/shared/smoothies.h. `quantum` is the largest error
/// of stored depths.
[[nodiscard]] std::vector<int> smoothiesOf(const CpuMap& map, const Tile& tile, int reach, double quantum);

} // namespace gnomon::test
