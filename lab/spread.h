// SPDX-License-Identifier: Apache-2.0
// What repeated times come to.
#pragma once

#include <vector>

namespace gnomon::lab {

struct Spread {
    double median = 0.0;
    double iqr = 0.0; // third quartile less the first
};
/// Quartiles by linear interpolation between order statistics (Hyndman & Fan 1996, type 7). Empty: zeros.
[[nodiscard]] Spread spreadOf(std::vector<double> values);

} // namespace gnomon::lab
