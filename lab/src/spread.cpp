// SPDX-License-Identifier: Apache-2.0
#include "lab/spread.h"

#include "lab/metrics/quantile.h"

#include <algorithm>
#include <utility>

namespace gnomon::lab {

Spread spreadOf(std::vector<double> values)
{
    if (values.empty()) {
        return {};
    }
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.75) - quantile(values, 0.25)};
}

std::optional<Spread> spreadOfMeasured(const std::vector<std::optional<double>>& values)
{
    std::vector<double> measured;
    for (const std::optional<double>& value : values) {
        if (!value) {
            return std::nullopt;
        }
        measured.push_back(*value);
    }
    return spreadOf(std::move(measured));
}

} // namespace gnomon::lab
