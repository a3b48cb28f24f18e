// SPDX-License-Identifier: Apache-2.0
// What repeated times come to.
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
/// The same of values that may be missing: nothing as soon as one is.
[[nodiscard]] std::optional<Spread> spreadOfMeasured(const std::vector<std::optional<double>>& values);

} // namespace gnomon::lab
