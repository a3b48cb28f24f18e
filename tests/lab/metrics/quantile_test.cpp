// SPDX-License-Identifier: Apache-2.0
#include "lab/metrics/quantile.h"

#include <gtest/gtest.h>

namespace gnomon::lab {
namespace {

TEST(Quantile, InterpolatesBetweenOrderStatistics)
{
    // Type 7: the share p of n values lies at place (n - 1) p, counted from 0.
    const std::vector<double> values{1.0, 2.0, 4.0, 8.0, 16.0};
    EXPECT_EQ(quantile(values, 0.0), 1.0);
    EXPECT_EQ(quantile(values, 0.5), 4.0);
    EXPECT_EQ(quantile(values, 1.0), 16.0);
    EXPECT_DOUBLE_EQ(quantile(values, 0.01), 1.04);
    EXPECT_DOUBLE_EQ(quantile(values, 0.99), 15.68);
    EXPECT_DOUBLE_EQ(quantile({1.0, 2.0, 3.0, 4.0}, 0.25), 1.75);
    EXPECT_EQ(quantile({7.0}, 0.3), 7.0);
}

} // namespace
} // namespace gnomon::lab
