// SPDX-License-Identifier: Apache-2.0
// One axis of a plot: its range, and round numbers along it.
#pragma once

#include <string>
#include <vector>

namespace gnomon::lab {

struct Tick {
    double value = 0.0;
    std::string label; // empty: a fine line without a number
};

struct Axis {
    double low = 0.0;
    double high = 1.0; // > low
    bool logarithmic = false;
    std::vector<Tick> ticks; // ascending, within [low, high]

    /// Where a value lies, from 0 at `low` to 1 at `high`.
    [[nodiscard]] double fraction(double value) const;
};

/// Where a linear axis ends: at the values themselves, or at the round numbers around them, which include zero where
/// it is no farther away than the values are apart.
enum class Ends { tight, round };

/// Whether an axis can show a value: finite, no larger than 1e300 so that differences stay finite, and above 1e-300
/// where it is logarithmic.
[[nodiscard]] bool isPlottable(double value, bool logarithmic);

/// Around all plottable of `values`; [0, 1] (logarithmic: [1, 10]) when there are none. Logarithmic axes end at the 1,
/// 2 or 5 times a power of ten around the values. `wanted`: about so many numbers.
[[nodiscard]] Axis makeAxis(const std::vector<double>& values, bool logarithmic, Ends ends, int wanted);

/// Logarithmic, from the smallest to the largest of `values` and with a tick at each, for a few that have been chosen
/// one by one. Both ends have labels, the others where there is room: `letter` is a letter's width as a share of the
/// axis. Precondition: ascending, plottable, two different values at least.
[[nodiscard]] Axis makeAxisAt(const std::vector<double>& values, double letter);

} // namespace gnomon::lab
