// SPDX-License-Identifier: Apache-2.0
// The median and the spread of repeated times.
#pragma once

#include <optional>
#include <vector>

namespace gnomon::lab {

struct Spread {
    double median = 0.0;
    double iqr = 0.0; // third quartile less the first
};
/// Quartiles by linear interpolation between order statistics (Hyndman & Fan 1996, type 7). Empty: zeros.
[[nodiscard]] Spread spreadOf(std::vector<double> values);
/// spreadOf() of values that may be missing: nothing when any is.
[[nodiscard]] std::optional<Spread> spreadOfMeasured(const std::vector<std::optional<double>>& values);

} // namespace gnomon::lab
