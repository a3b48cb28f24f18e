// SPDX-License-Identifier: Apache-2.0
// Numbers that change in steps, so that what depends on them stays the same from frame to frame.
#pragma once

#include <cmath>

namespace gnomon {

/// `value` > 0 and what rounding adds to it, up to the next 64th of the power of two below it.
[[nodiscard]] inline double steppedUp(double value)
{
    constexpr double kRounding = 1e-9;
    const double step = std::exp2(std::floor(std::log2(value))) / 64.0;
    return std::ceil(value * (1.0 - kRounding) / step) * step;
}

struct SteppedRange {
    double low = 0.0;
    double high = 0.0;
};
/// The smallest range around [low, high] whose ends are multiples of an eighth of a power of two that is not less than
/// its size. low < high.
[[nodiscard]] inline SteppedRange steppedRange(double low, double high)
{
    const double step = std::exp2(std::ceil(std::log2(high - low))) / 8.0;
    return {std::floor(low / step) * step, std::ceil(high / step) * step};
}

/// The smallest range around [low, high] whose ends are powers of the fourth root of two. 0 < low < high.
[[nodiscard]] inline SteppedRange steppedRatio(double low, double high)
{
    return {std::exp2(std::floor(std::log2(low) * 4.0) / 4.0), std::exp2(std::ceil(std::log2(high) * 4.0) / 4.0)};
}

} // namespace gnomon
