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

TEST(DepthMetric, MapsNearToZeroAndFarToOneInOrder)
{
    EXPECT_EQ(depthMetricLinear(2.0, 2.0, 10.0), 0.0);
    EXPECT_EQ(depthMetricLinear(10.0, 2.0, 10.0), 1.0);
    EXPECT_DOUBLE_EQ(depthMetricLinear(4.0, 2.0, 10.0), 0.25);
    double last = -1.0;
    for (double d = 0.0; d < 12.0; d += 0.01) {
        const double metric = depthMetricLinear(d, 2.0, 10.0);
        EXPECT_GT(metric, last);
        last = metric;
    }
}

TEST(DepthMetric, TightPlanesBuyPrecisionInProportion)
{
    // Marinescu 2011: 1 .. 10000 against 1 .. 100 is a factor 100.
    const double wide = depthMetricLinear(51.0, 1.0, 10001.0) - depthMetricLinear(50.0, 1.0, 10001.0);
    const double tight = depthMetricLinear(51.0, 1.0, 101.0) - depthMetricLinear(50.0, 1.0, 101.0);
    EXPECT_NEAR(tight / wide, 100.0, 1e-9);
}

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

TEST(DepthMetric, PerVertexInterpolationIsExact)
{
    const real4 metric(0.02, -0.07, 0.01, 0.4);
    const real3 a(1, 2, 3);
    const real3 b(-4, 0, 7);
    for (double t = 0.0; t <= 1.0; t += 0.05) {
        const real3 p = a * (1.0 - t) + b * t;
        EXPECT_NEAR(depthMetricPlane(p, metric),
                    depthMetricPlane(a, metric) * (1.0 - t) + depthMetricPlane(b, metric) * t, 1e-15);
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
