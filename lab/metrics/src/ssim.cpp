// SPDX-License-Identifier: Apache-2.0
// Based on: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error Visibility to
// Structural Similarity", 2004. Departures: the window is cut and renormalised at the border, so that every pixel has a
// value, and the mean is over the counted pixels.
#include "lab/metrics/error.h"

#include "lab/metrics/same_shape.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::lab {
namespace {

constexpr int kReachPx = 5; // 11 x 11 pixels
constexpr double kSigmaPx = 1.5;
constexpr double kC1 = 0.01 * 0.01; // eq. 7: (K1 L)^2, the range L being 1
constexpr double kC2 = 0.03 * 0.03; // eq. 9: (K2 L)^2

using Window = std::array<double, 2 * kReachPx + 1>;

/// One axis of the window: the Gaussian is separable, and so is the cut rectangle at the border.
Window gaussian()
{
    Window window{};
    double sum = 0.0;
    for (int k = -kReachPx; k <= kReachPx; ++k) {
        window[k + kReachPx] = std::exp(-k * k / (2.0 * kSigmaPx * kSigmaPx));
        sum += window[k + kReachPx];
    }
    for (double& weight : window) {
        weight /= sum;
    }
    return window;
}

/// The places k of the window at `place` that lie in [0, size), from `first` to `last`, and the sum of their weights.
struct Cut {
    int first = 0;
    int last = 0;
    double weight = 0.0;
};
Cut cutWindow(const Window& window, std::size_t place, std::size_t size)
{
    Cut cut;
    cut.first = -static_cast<int>(std::min<std::size_t>(kReachPx, place));
    cut.last = static_cast<int>(std::min<std::size_t>(kReachPx, size - 1 - place));
    for (int k = cut.first; k <= cut.last; ++k) {
        cut.weight += window[k + kReachPx];
    }
    return cut;
}

/// Weighted sums of the test a and the truth b.
struct Moments {
    double a = 0.0;
    double b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
};

/// Down the columns of the window around row y, before the sums along the row.
void sumColumns(const ImageF& test, const ImageF& truth, const Window& window, std::size_t y,
                std::vector<Moments>& columns)
{
    const std::size_t width = test.width;
    std::fill(columns.begin(), columns.end(), Moments{});
    const Cut cut = cutWindow(window, y, test.height);
    for (int k = cut.first; k <= cut.last; ++k) {
        const double weight = window[k + kReachPx] / cut.weight;
        const std::size_t row = (y + k) * width;
        for (std::size_t x = 0; x < width; ++x) {
            const double a = test.values[row + x];
            const double b = truth.values[row + x];
            Moments& sums = columns[x];
            sums.a += weight * a;
            sums.b += weight * b;
            sums.aa += weight * (a * a);
            sums.bb += weight * (b * b);
            sums.ab += weight * (a * b);
        }
    }
}

Moments sumWindow(const std::vector<Moments>& columns, const Window& window, std::size_t x)
{
    Moments sums;
    const Cut cut = cutWindow(window, x, columns.size());
    for (int k = cut.first; k <= cut.last; ++k) {
        const double weight = window[k + kReachPx] / cut.weight;
        const Moments& column = columns[x + k];
        sums.a += weight * column.a;
        sums.b += weight * column.b;
        sums.aa += weight * column.aa;
        sums.bb += weight * column.bb;
        sums.ab += weight * column.ab;
    }
    return sums;
}

/// Eq. 13, with means, variances and covariance as in eq. 14 to 16. Equal images give exactly 1, because then every
/// factor above equals its factor below.
double similarity(const Moments& sums)
{
    const double variance_a = sums.aa - sums.a * sums.a;
    const double variance_b = sums.bb - sums.b * sums.b;
    const double covariance = sums.ab - sums.a * sums.b;
    return (2.0 * sums.a * sums.b + kC1) * (2.0 * covariance + kC2) /
           ((sums.a * sums.a + sums.b * sums.b + kC1) * (variance_a + variance_b + kC2));
}

} // namespace

std::optional<double> ssim(const ImageF& test, const ImageF& truth, const Counted& counted)
{
    assert(areMasksOfOneSize(test, truth));
    assert(areMasksOfOneSize(test, counted));
    const std::size_t width = test.width;
    ImageF shown = test;
    for (std::size_t i = 0; i < counted.values.size(); ++i) {
        if (counted.values[i] == 0) {
            shown.values[i] = truth.values[i];
        }
    }
    const Window window = gaussian();
    std::vector<Moments> columns(width);
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t y = 0; y < test.height; ++y) {
        const std::uint8_t* counts = counted.values.data() + y * width;
        if (std::all_of(counts, counts + width, [](std::uint8_t value) { return value == 0; })) {
            continue;
        }
        sumColumns(shown, truth, window, y, columns);
        for (std::size_t x = 0; x < width; ++x) {
            if (counts[x] != 0) {
                sum += similarity(sumWindow(columns, window, x));
                ++count;
            }
        }
    }
    if (count == 0) {
        return std::nullopt;
    }
    return sum / static_cast<double>(count);
}

} // namespace gnomon::lab
