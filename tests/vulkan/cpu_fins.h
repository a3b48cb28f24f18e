// SPDX-License-Identifier: Apache-2.0
// The fins beside a map of the scene of boxes, computed edge by edge on the CPU.
#pragma once

#include "cpu_map.h"
#include "scene.h"

#include <vector>

namespace gnomon::test {

/// The fins' texels as smoothiesOf() gives smoothies'.
[[nodiscard]] std::vector<int> finsOf(const Scene& scene, const View& view, const CpuMap& map, int reach,
                                      double quantum);

} // namespace gnomon::test
