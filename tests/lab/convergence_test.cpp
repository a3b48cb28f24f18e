// SPDX-License-Identifier: Apache-2.0
// The error of hard shadows against their truth shrinks as it must when the map grows: a map's wrong pixels lie in a
// band along each edge, as wide as a texel. Twice the side halves the band, and with it the mean squared error, so that
// rmse falls by the square root of two: half a power of two for each doubling.
#include "stage.h"

#include "worlds/worlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace gnomon::lab::test {
namespace {

/// The slope of the straight line that fits best through values at 0, 1, 2 and so on.
double slopeOf(const std::vector<double>& values)
{
    const double middle = static_cast<double>(values.size() - 1) / 2.0;
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = static_cast<double>(i) - middle;
        product += x * values[i];
        square += x * x;
    }
    return product / square;
}

/// log2 of the rmse at map sizes 128, 256, ... 4096; prints a table.
std::vector<double> errorsBySize(Stage& stage, const std::string& name)
{
    std::vector<double> logs;
    std::printf("%s\n  map    rmse      texels per pixel\n", name.c_str());
    for (std::uint32_t size = 128; size <= 4096; size *= 2) {
        const Score score = stage.score(hardOptions(size));
        const double rmse = score.error.value().rmse;
        std::printf("%5u   %.5f   %.3f\n", size, rmse, score.density.p50);
        logs.push_back(std::log2(rmse));
    }
    std::printf("log2(rmse) per doubling: %.3f\n", slopeOf(logs));
    return logs;
}

void expectFall(const std::vector<double>& logs, double least_slope, double greatest_slope)
{
    for (std::size_t i = 1; i < logs.size(); ++i) {
        EXPECT_LT(logs[i], logs[i - 1]) << "from " << (128U << (i - 1)) << " to " << (128U << i);
    }
    EXPECT_GE(slopeOf(logs), least_slope);
    EXPECT_LE(slopeOf(logs), greatest_slope);
}

TEST(Convergence, OfHardOnPlanesUnderTheSun)
{
    Stage stage(worlds::load("planes", 1), "side", {960, 540}, 0);
    // The world's own sun falls along an axis of the box, and whether texels' borders meet its edges is then luck.
    stage.turnLight({2.0, -4.0, 1.1});
    expectFall(errorsBySize(stage, "planes, sun from a corner"), -0.6, -0.4);
}

TEST(Convergence, OfHardOnPlanesUnderTheSpot)
{
    Stage stage(worlds::load("planes", 1), "side", {960, 540}, 1);
    expectFall(errorsBySize(stage, "planes, spot"), -0.6, -0.4);
}

TEST(Convergence, OfHardOnTheStrategyWorld)
{
    // Leaves, palings and ropes are narrower than a texel or a pixel for long, so there is not a band along an edge
    // yet, and the error falls more slowly.
    Stage stage(worlds::load("rts", 1), "camp", {256, 144});
    expectFall(errorsBySize(stage, "rts, camp"), -0.5, -0.25);
}

} // namespace
} // namespace gnomon::lab::test
