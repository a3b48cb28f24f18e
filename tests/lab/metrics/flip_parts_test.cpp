// SPDX-License-Identifier: Apache-2.0
// The parts of FLIP against closed forms, published colours and the paper's filters in two dimensions.
#include "flip_images.h"
#include "lab/metrics/src/flip_colour.h"
#include "lab/metrics/src/flip_filters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace gnomon::lab::flip_parts {
namespace {

constexpr double kPi = std::numbers::pi;

double sum(const Kernel& kernel)
{
    return std::accumulate(kernel.begin(), kernel.end(), 0.0);
}

double sumOfPositive(const Kernel& kernel)
{
    return std::accumulate(kernel.begin(), kernel.end(), 0.0,
                           [](double so_far, double weight) { return weight > 0.0 ? so_far + weight : so_far; });
}

Plane noisePlane(std::size_t width, std::size_t height)
{
    Plane plane(width, height);
    flip_images::Noise noise(4242u);
    for (double& value : plane.values) {
        value = noise.next();
    }
    return plane;
}

TEST(FlipColour, GreyHasNoChroma)
{
    for (const double grey : {0.0, 0.001, 0.2, 1.0}) {
        const Opponent colour = opponentFromLinear({grey, grey, grey});
        EXPECT_NEAR(colour.y, 116.0 * grey - 16.0, 1e-12);
        EXPECT_NEAR(colour.cx, 0.0, 1e-12);
        EXPECT_NEAR(colour.cz, 0.0, 1e-12);
        EXPECT_NEAR(luminance(colour.y), grey, 1e-14);
    }
}

TEST(FlipColour, ComesBackFromOpponentSpace)
{
    flip_images::Noise noise(7u);
    for (int i = 0; i < 100; ++i) {
        const LinearRgb rgb{noise.next(), noise.next(), noise.next()};
        const LinearRgb back = linearFromOpponent(opponentFromLinear(rgb));
        EXPECT_NEAR(back.r, rgb.r, 1e-7); // the published inverse is good to single precision
        EXPECT_NEAR(back.g, rgb.g, 1e-7);
        EXPECT_NEAR(back.b, rgb.b, 1e-7);
    }
}

TEST(FlipColour, KnowsTheLabOfThePrimaries)
{
    // sRGB's primaries in L*a*b* as tables give them, a* and b* times L* / 100.
    const HuntLab red = huntLabFromLinear({1, 0, 0});
    EXPECT_NEAR(red.l, 53.24, 0.01);
    EXPECT_NEAR(red.a, 0.5324 * 80.09, 0.02);
    EXPECT_NEAR(red.b, 0.5324 * 67.20, 0.02);
    const HuntLab green = huntLabFromLinear({0, 1, 0});
    EXPECT_NEAR(green.l, 87.73, 0.01);
    EXPECT_NEAR(green.a, 0.8773 * -86.18, 0.02);
    EXPECT_NEAR(green.b, 0.8773 * 83.18, 0.02);
    const HuntLab blue = huntLabFromLinear({0, 0, 1});
    EXPECT_NEAR(blue.l, 32.30, 0.01);
    EXPECT_NEAR(blue.a, 0.3230 * 79.19, 0.02);
    EXPECT_NEAR(blue.b, 0.3230 * -107.86, 0.02);
}

TEST(FlipColour, TakesTheTangentNearBlack)
{
    // Below (6/29)^3 lightness is linear, (29/3)^3 times luminance, and meets the cube root without a step.
    EXPECT_NEAR(huntLabFromLinear({0, 0, 0}).l, 0.0, 1e-12);
    EXPECT_NEAR(huntLabFromLinear({0.004, 0.004, 0.004}).l, 0.004 * std::pow(29.0 / 3.0, 3), 1e-9);
    EXPECT_NEAR(huntLabFromLinear({0.008856, 0.008856, 0.008856}).l,
                huntLabFromLinear({0.008857, 0.008857, 0.008857}).l, 1e-3);
}

TEST(FlipColour, AddsLightnessToChroma)
{
    EXPECT_DOUBLE_EQ(hyab({10, 3, 0}, {30, 0, 4}), 25.0);
    EXPECT_DOUBLE_EQ(hyab({30, 0, 4}, {10, 3, 0}), 25.0);
}

TEST(FlipColour, ClampsToTheCube)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const LinearRgb clamped = clampToCube({-0.5, 2.0, nan});
    EXPECT_EQ(clamped.r, 0.0);
    EXPECT_EQ(clamped.g, 1.0);
    EXPECT_TRUE(std::isnan(clamped.b));
}

TEST(FlipColour, SpreadsDistancesOverTheUnitInterval)
{
    const Redistribution redistribute;
    EXPECT_NEAR(redistribute.largest(), 41.27610, 1e-5); // the authors' code gives 41.276096 in single precision
    EXPECT_EQ(redistribute(0.0), 0.0);
    const double knee = std::pow(0.4 * redistribute.largest(), 1.0 / 0.7);
    EXPECT_NEAR(redistribute(knee), 0.95, 1e-12);
    EXPECT_NEAR(redistribute(knee * std::pow(0.5, 1.0 / 0.7)), 0.475, 1e-12);
    EXPECT_NEAR(redistribute(std::pow(0.7 * redistribute.largest(), 1.0 / 0.7)), 0.975, 1e-12);
    EXPECT_EQ(redistribute(std::pow(redistribute.largest(), 1.0 / 0.7) + 1.0), 1.0);
    EXPECT_TRUE(std::isnan(redistribute(std::numeric_limits<double>::quiet_NaN())));
}

TEST(FlipColour, FindsNoColoursFartherApartThanGreenAndBlue)
{
    std::vector<HuntLab> colours;
    for (int r = 0; r <= 8; ++r) {
        for (int g = 0; g <= 8; ++g) {
            for (int b = 0; b <= 8; ++b) {
                colours.push_back(huntLabFromLinear({r * r / 64.0, g * g / 64.0, b * b / 64.0}));
            }
        }
    }
    double farthest = 0.0;
    for (const HuntLab& first : colours) {
        for (const HuntLab& second : colours) {
            farthest = std::max(farthest, hyab(first, second));
        }
    }
    EXPECT_NEAR(farthest, hyab(huntLabFromLinear({0, 1, 0}), huntLabFromLinear({0, 0, 1})), 1e-12);
}

TEST(FlipFilters, HaveTheReachAndSumsOfThePaper)
{
    const ContrastFilters filters = contrastFilters(67.0);
    ASSERT_EQ(filters.achromatic.lobes.size(), 1u);
    ASSERT_EQ(filters.red_green.lobes.size(), 1u);
    ASSERT_EQ(filters.blue_yellow.lobes.size(), 2u);
    for (const ContrastFilter* filter : {&filters.achromatic, &filters.red_green, &filters.blue_yellow}) {
        double shares = 0.0;
        for (const Lobe& lobe : filter->lobes) {
            EXPECT_EQ(lobe.kernel.size(), 21u); // 3 sqrt(0.04 / (2 pi^2)) x 67 = 9.05 pixels to each side
            EXPECT_NEAR(sum(lobe.kernel), 1.0, 1e-14);
            shares += lobe.share;
        }
        EXPECT_NEAR(shares, 1.0, 1e-14);
    }
    const FeatureKernels features = featureKernels(67.0);
    EXPECT_EQ(features.edge.size(), 19u); // 3 x 0.041 x 67 = 8.24 pixels to each side
    EXPECT_NEAR(sum(features.smooth), 1.0, 1e-14);
    for (const Kernel* derivative : {&features.edge, &features.point}) {
        EXPECT_NEAR(sum(*derivative), 0.0, 1e-14);
        EXPECT_NEAR(sumOfPositive(*derivative), 1.0, 1e-14);
    }
}

// The paper's filter of the blue-yellow channel as it stands: a sum of two round Gaussians in two dimensions, divided
// by its sum, over the nearest pixels beyond the border.
TEST(FlipFilters, AreThePapersInTwoDimensions)
{
    const double pixels_per_degree = 30.0;
    const auto weight = [&](int x, int y) {
        const double squared_deg = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
        return 34.1 * std::sqrt(kPi / 0.04) * std::exp(-kPi * kPi * squared_deg / 0.04) +
               13.5 * std::sqrt(kPi / 0.025) * std::exp(-kPi * kPi * squared_deg / 0.025);
    };
    const int width = 9;
    const int height = 12;
    const int radius = 5; // 3 sqrt(0.04 / (2 pi^2)) x 30 = 4.05
    const Plane plane = noisePlane(width, height);
    const Plane filtered = applyFilter(plane, contrastFilters(pixels_per_degree).blue_yellow);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double weighted = 0.0;
            double weights = 0.0;
            for (int dy = -radius; dy <= radius; ++dy) {
                for (int dx = -radius; dx <= radius; ++dx) {
                    const auto from_y = static_cast<std::size_t>(std::clamp(y + dy, 0, height - 1));
                    const auto from_x = static_cast<std::size_t>(std::clamp(x + dx, 0, width - 1));
                    weighted += weight(dx, dy) * plane.row(from_y)[from_x];
                    weights += weight(dx, dy);
                }
            }
            EXPECT_NEAR(filtered.row(static_cast<std::size_t>(y))[x], weighted / weights, 1e-12);
        }
    }
}

TEST(FlipFilters, LeaveFlatLightAsItIs)
{
    Plane flat(5, 3);
    std::fill(flat.values.begin(), flat.values.end(), 0.75);
    for (const double value : applyFilter(flat, contrastFilters(67.0).blue_yellow).values) {
        EXPECT_NEAR(value, 0.75, 1e-14);
    }
    const Features features = findFeatures(flat, featureKernels(67.0));
    for (std::size_t i = 0; i < flat.values.size(); ++i) {
        EXPECT_NEAR(features.edge.values[i], 0.0, 1e-14);
        EXPECT_NEAR(features.point.values[i], 0.0, 1e-14);
    }
}

TEST(FlipFilters, FindAnEdgeInEachDirectionAlike)
{
    const FeatureKernels kernels = featureKernels(67.0);
    Plane upright(41, 41);
    Plane level(41, 41);
    for (std::size_t y = 0; y < 41; ++y) {
        for (std::size_t x = 0; x < 41; ++x) {
            upright.row(y)[x] = x > 20 ? 1.0 : 0.0;
            level.row(y)[x] = y > 20 ? 1.0 : 0.0;
        }
    }
    const Features of_upright = findFeatures(upright, kernels);
    const Features of_level = findFeatures(level, kernels);
    EXPECT_NEAR(of_upright.edge.row(20)[20], 1.0, 1e-12); // all positive weights see light, all negative ones dark
    EXPECT_NEAR(of_upright.edge.row(20)[20], of_level.edge.row(20)[20], 1e-12);
    EXPECT_NEAR(of_upright.edge.row(20)[5], 0.0, 1e-12); // beyond its reach
    for (std::size_t x = 0; x < 41; ++x) {
        EXPECT_NEAR(of_upright.point.row(20)[x], of_level.point.row(x)[20], 1e-12);
    }
}

TEST(FlipFilters, FindAPoint)
{
    const FeatureKernels kernels = featureKernels(67.0);
    Plane plane(31, 31);
    plane.row(15)[15] = 1.0;
    const Features features = findFeatures(plane, kernels);
    const double response = kernels.point[9] * kernels.smooth[9];
    EXPECT_NEAR(features.point.row(15)[15], std::sqrt(2.0) * std::abs(response), 1e-14);
    EXPECT_NEAR(features.edge.row(15)[15], 0.0, 1e-14);
    for (const double value : features.point.values) {
        EXPECT_LE(value, features.point.row(15)[15] + 1e-14);
    }
}

} // namespace
} // namespace gnomon::lab::flip_parts
