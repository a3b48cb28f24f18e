// SPDX-License-Identifier: Apache-2.0
// The text that the shaders include, in double precision.
#define GNOMON_REAL double
#include <gnomon/shared/depth_metric.h>

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace gnomon::shared {
namespace {

static_assert(std::is_same_v<real, double>);

TEST(DepthMetric, PlaneFormEqualsTheDistanceForm)
{
    const real3 place(3.0, 20.0, -4.0);
    const real3 forward = normalize(real3(0.3, -1.0, 0.2));
    const double near_m = 1.5;
    const double far_m = 40.0;
    const real4 metric(forward / (far_m - near_m), (-dot(forward, place) - near_m) / (far_m - near_m));
    for (int i = 0; i < 200; ++i) {
        const real3 p(std::sin(i * 1.0) * 30.0, std::cos(i * 2.0) * 15.0, std::sin(i * 3.0) * 25.0);
        EXPECT_NEAR(depthMetricPlane(p, metric), depthMetricLinear(dot(forward, p - place), near_m, far_m), 1e-14);
    }
}

TEST(DepthMetric, StoredIsClamped)
{
    EXPECT_EQ(depthMetricStored(-3.0), 0.0);
    EXPECT_EQ(depthMetricStored(0.25), 0.25);
    EXPECT_EQ(depthMetricStored(7.0), 1.0);
}

} // namespace
} // namespace gnomon::shared
