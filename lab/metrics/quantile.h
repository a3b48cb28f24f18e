// SPDX-License-Identifier: Apache-2.0
// Quantiles of measured values: times, densities.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::lab {

/// By linear interpolation between order statistics (Hyndman & Fan, "Sample Quantiles in Statistical Packages", 1996,
/// type 7). Preconditions: ascending, not empty, no NaN; `share` in [0, 1].
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double share)
{
    assert(!sorted.empty() && share >= 0.0 && share <= 1.0);
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(std::floor(place));
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (sorted[high] - sorted[low]) * (place - static_cast<double>(low));
}

} // namespace gnomon::lab
