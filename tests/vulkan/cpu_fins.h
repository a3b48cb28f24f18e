// SPDX-License-Identifier: Apache-2.0
// What fins lie beside a map of the scene of boxes, worked out edge by edge on the CPU.
#pragma once

#include "cpu_map.h"
#include "scene.h"

#include <vector>

namespace gnomon::test {

/// As smoothiesOf().
[[nodiscard]] std::vector<int> finsOf(const Scene& scene, const View& view, const CpuMap& map, int reach,
                                      double quantum);

} // namespace gnomon::test
