// SPDX-License-Identifier: Apache-2.0
// Truth over the area of pixels, against closed forms and against the mean of many smaller pixels.
#include "pixel_points.h"
#include "support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::truth::test {
namespace {

Options overPixels(Options options)
{
    options.pixels = PixelTruth::area;
    return options;
}

/// A roof over the left half of a floor, seen through from above; its edge is at x = `edge`.
scene::Scene halfRoof(float edge)
{
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 50.0F)));
    place(scene, addQuad(scene, ceiling(1.0F, -40.0F, edge, 40.0F)));
    return scene;
}

const Light kNoon = sun({0.0, -1.0, 0.0});

TEST(PixelTruth, OfAHardEdgeIsTheShareOfThePixelThatIsLit)
{
    // A pixel of an eighth of a metre, whose left border is at x = 0.
    constexpr double kSide_m = 0.125;
    for (const float share : {0.1F, 0.25F, 0.5F, 0.8F}) {
        scene::Scene scene = halfRoof(share * static_cast<float>(kSide_m));
        const View view = lookDown(0.0, 10.0, 8 * kSide_m, {16, 16});
        const Traced traced = trace(scene, view, kNoon, overPixels(hard()));
        expectSound(traced);
        double sum = 0.0;
        for (std::uint32_t y = 0; y < 16; ++y) {
            EXPECT_EQ(traced.at(7, y), 0.0);
            EXPECT_EQ(traced.at(9, y), 1.0);
            // Each set has one point in each sixteenth of the side.
            EXPECT_NEAR(traced.at(8, y), 1.0 - share, 1.0 / 16.0);
            sum += traced.at(8, y);
        }
        EXPECT_NEAR(sum / 16.0, 1.0 - share, 0.01);
        // At centres it is all or nothing.
        EXPECT_EQ(trace(scene, view, kNoon, hard()).at(8, 8), share < 0.5F ? 1.0 : 0.0);
    }
}

// Two ways to one mean: points within pixels, and the centres of 64 times as many.
TEST(PixelTruth, IsTheMeanOfManySmallerPixels)
{
    constexpr std::uint32_t kFiner = 8;
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 50.0F)));
    place(scene, addBall(scene, 8), glm::mat4(1.0F)).matrix[3] = {0.0F, 1.5F, 0.0F, 1.0F};
    const Light light = sun({0.4, -1.0, 0.3}, 0.2);
    const auto viewOf = [](std::uint32_t scale) {
        return lookAt({3.0, 4.0, 3.0}, {0.3, 0.5, 0.3}, 0.7, glm::uvec2(16 * scale));
    };
    const Traced coarse = trace(scene, viewOf(1), light, overPixels(area(1024)));
    const Traced fine = trace(scene, viewOf(kFiner), light, area(64));
    expectSound(coarse);
    std::uint32_t partly = 0;
    double squares = 0.0;
    double errors = 0.0;
    for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 16; ++x) {
            double sum = 0.0;
            for (std::uint32_t j = 0; j < kFiner; ++j) {
                for (std::uint32_t i = 0; i < kFiner; ++i) {
                    sum += fine.at(x * kFiner + i, y * kFiner + j);
                }
            }
            const double mean = sum / (kFiner * kFiner);
            const double difference = coarse.at(x, y) - mean;
            EXPECT_NEAR(difference, 0.0, 0.1) << x << ' ' << y;
            squares += difference * difference;
            errors += std::pow(*coarse.visibility.standard_error.pixel(x, y), 2.0);
            partly += mean > 0.05 && mean < 0.95 ? 1 : 0;
        }
    }
    EXPECT_GT(partly, 40U);
    EXPECT_LT(std::sqrt(squares / 256.0), 0.012);
    EXPECT_LT(std::sqrt(errors / 256.0), 0.02) << "and its own idea of the error is no other";
    EXPECT_GT(std::sqrt(errors / 256.0), 0.002);
}

// Half of the pixel sees the sky, or what does not receive: they play no part.
TEST(PixelTruth, CountsReceiversAlone)
{
    scene::Scene scene;
    place(scene, addQuad(scene, Corners{glm::vec3(-8.0F, 0.0F, 8.0F), glm::vec3(0.02F, 0.0F, 8.0F),
                                        glm::vec3(0.02F, 0.0F, -8.0F), glm::vec3(-8.0F, 0.0F, -8.0F)}));
    place(scene, addQuad(scene, ceiling(1.0F, -8.0F, 8.0F, 8.0F)));
    const View view = lookDown(0.0, 10.0, 0.24, {16, 16}); // the floor ends in pixel 8, beyond its centre
    const Traced traced = trace(scene, view, kNoon, overPixels(hard()));
    EXPECT_EQ(traced.at(8, 8), 0.0);
    EXPECT_EQ(traced.id(9, 8), 0U);
    EXPECT_EQ(traced.at(9, 8), 1.0);
}

TEST(PixelTruth, SharesItsRaysAmongItsPoints)
{
    EXPECT_EQ(raysPerPixel(hard()), 1U);
    EXPECT_EQ(raysPerPixel(area(256)), 256U);
    EXPECT_EQ(raysPerPixel(overPixels(hard())), kPixelPoints);
    EXPECT_EQ(raysPerPixel(overPixels(area(4))), kPixelPoints * kSampleSets);
    EXPECT_EQ(raysPerPixel(overPixels(area(1024))), 1024U);
    scene::Scene scene = halfRoof(0.0F);
    const Options options = overPixels(area(64));
    const Traced traced = trace(scene, lookDown(0.0, 10.0, 1.0, {8, 8}), kNoon, options);
    EXPECT_GE(traced.visibility.rays, 64U * raysPerPixel(options));
    EXPECT_LE(traced.visibility.rays, 96U * raysPerPixel(options)) << "some look for what blocks";
}

// Each sixteenth of a side has its point, in every set.
TEST(PixelTruth, PointsAreSpreadOverThePixel)
{
    constexpr std::uint32_t kPoints = kPixelPoints / kSampleSets;
    for (std::uint32_t set = 0; set < kSampleSets; ++set) {
        std::array<int, kPoints> columns{};
        std::array<int, kPoints> rows{};
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const glm::dvec2 p = pointInPixel(1, 77, set, i);
            ASSERT_TRUE(p.x >= 0.0 && p.x < 1.0 && p.y >= 0.0 && p.y < 1.0);
            ++columns[static_cast<std::size_t>(kPoints * p.x)];
            ++rows[static_cast<std::size_t>(kPoints * p.y)];
        }
        for (const std::array<int, kPoints>& counts : {columns, rows}) {
            EXPECT_EQ(std::ranges::count(counts, 1), static_cast<int>(kPoints));
        }
    }
    EXPECT_NE(pointInPixel(1, 77, 0, 0), pointInPixel(1, 78, 0, 0));
    EXPECT_NE(pointInPixel(1, 77, 0, 0), pointInPixel(2, 77, 0, 0));
}

} // namespace
} // namespace gnomon::truth::test
