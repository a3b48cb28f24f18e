// SPDX-License-Identifier: Apache-2.0
// What smoothies lie beside a map, worked out texel by texel on the CPU.
#pragma once

#include "cpu_map.h"

#include <gnomon/plan.h>

#include <vector>

namespace gnomon::test {

/// Of the texels of a tile, row by row, packed as gnomon/shared/smoothies.h has it. `quantum`: what stored depths may
/// be off by.
[[nodiscard]] std::vector<int> smoothiesOf(const CpuMap& map, const Tile& tile, int reach, double quantum);

} // namespace gnomon::test
