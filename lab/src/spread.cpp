// SPDX-License-Identifier: Apache-2.0
#include "lab/spread.h"

#include "lab/metrics/quantile.h"

#include <algorithm>

namespace gnomon::lab {

Spread spreadOf(std::vector<double> values)
{
    if (values.empty()) {
        return {};
    }
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.75) - quantile(values, 0.25)};
}

} // namespace gnomon::lab
