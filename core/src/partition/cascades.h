// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "partition/partition.h"

namespace gnomon {

/// Where the i-th of `count` slices begins, metres from the eye: near_m for 0, far_m for `count`. Zhang et al. 2006,
/// eq.
/// 5. 0 < near_m <= far_m.
[[nodiscard]] double practicalSplit(double near_m, double far_m, double lambda, std::uint32_t i, std::uint32_t count);

} // namespace gnomon
