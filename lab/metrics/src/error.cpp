// SPDX-License-Identifier: Apache-2.0
#include "lab/metrics/error.h"

#include "lab/metrics/same_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon::lab {
namespace {

/// The smallest of `values` that at least 99 % of them do not exceed (nearest rank): the one of rank ceil(0.99 n),
/// counted from 1. In integers ceil(0.99 n) = n - floor(n / 100), so that no rounding of 0.99 can move the rank.
/// Precondition: not empty, no NaN, for which there is no order.
double percentile99(std::vector<double>& values)
{
    const std::size_t rank = values.size() - values.size() / 100;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace

std::optional<ErrorNumbers> errorNumbers(const ImageF& test, const ImageF& truth, const Counted& counted)
{
    assert(areMasksOfOneSize(test, truth));
    assert(areMasksOfOneSize(test, counted));
    double sum = 0.0;
    double sum_of_sizes = 0.0;
    double sum_of_squares = 0.0;
    bool all_are_numbers = true;
    std::vector<double> sizes;
    sizes.reserve(counted.values.size());
    for (std::size_t i = 0; i < counted.values.size(); ++i) {
        if (counted.values[i] == 0) {
            continue;
        }
        // In double before the difference is taken, so that nothing is lost in it.
        const double e = static_cast<double>(test.values[i]) - static_cast<double>(truth.values[i]);
        all_are_numbers = all_are_numbers && !std::isnan(e);
        sum += e;
        sum_of_sizes += std::abs(e);
        sum_of_squares += e * e;
        sizes.push_back(std::abs(e));
    }
    if (sizes.empty()) {
        return std::nullopt;
    }
    if (!all_are_numbers) {
        constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
        return ErrorNumbers{.rmse = kNan, .mae = kNan, .bias = kNan, .p99 = kNan};
    }
    const auto count = static_cast<double>(sizes.size());
    ErrorNumbers numbers;
    numbers.rmse = std::sqrt(sum_of_squares / count);
    numbers.mae = sum_of_sizes / count;
    numbers.bias = sum / count;
    numbers.p99 = percentile99(sizes);
    return numbers;
}

Counted countAll(std::uint32_t width, std::uint32_t height)
{
    return Counted(width, height, 1, 1);
}

Counted without(const Counted& counted, const Counted& other)
{
    assert(areMasksOfOneSize(counted, other));
    Counted rest = counted;
    for (std::size_t i = 0; i < rest.values.size(); ++i) {
        rest.values[i] = counted.values[i] != 0 && other.values[i] == 0 ? 1 : 0;
    }
    return rest;
}

} // namespace gnomon::lab
