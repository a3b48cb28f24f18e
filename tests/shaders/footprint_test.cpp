// SPDX-License-Identifier: Apache-2.0
// Levels and reads from a pixel's footprint, and how a filterable map is read with them.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::shared {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec2 turned(glm::dvec2 v, double angle)
{
    return {v.x * std::cos(angle) - v.y * std::sin(angle), v.x * std::sin(angle) + v.y * std::cos(angle)};
}

TEST(Footprint, isotropicLevelIsTheLogarithmOfItsWidth)
{
    for (const double angle : {0.0, 0.4, 2.0}) {
        for (const double width : {1.0, 2.0, 3.0, 8.0}) {
            const glm::dvec2 x = turned({width, 0.0}, angle);
            const glm::dvec2 y = turned({0.0, width}, angle);
            EXPECT_NEAR(footprintLevel(x, y, 9.0), std::log2(width), 1e-12);
            const FootprintReads r = footprintReads(x, y, 9.0, 8.0);
            EXPECT_EQ(r.reads, 1);
            EXPECT_NEAR(r.level, std::log2(width), 1e-12);
        }
    }
    EXPECT_EQ(footprintLevel({0.3, 0.0}, {0.0, 0.1}, 9.0), 0.0) << "magnified";
    EXPECT_EQ(footprintLevel({64.0, 0.0}, {0.0, 64.0}, 3.0), 3.0) << "bounded by the coarsest";
}

TEST(Footprint, stretchedFourToOneTakesFourReadsAtTheShorterSidesLevel)
{
    for (const double angle : {0.0, 0.7, 1.5, 3.0}) {
        for (const bool swapped : {false, true}) {
            const glm::dvec2 along = turned({8.0, 0.0}, angle);
            const glm::dvec2 across = turned({0.0, 2.0}, angle);
            const FootprintReads r =
                swapped ? footprintReads(across, along, 9.0, 8.0) : footprintReads(along, across, 9.0, 8.0);
            EXPECT_EQ(r.reads, 4);
            EXPECT_NEAR(r.level, 1.0, 1e-12);
            // Along the longer side, either way round; reads tile it without gaps.
            EXPECT_NEAR(std::abs(glm::dot(r.step, along) / 8.0), 2.0, 1e-12);
            EXPECT_NEAR(glm::length(r.step), 2.0, 1e-12);
        }
    }
    // Fewer reads than it takes: each covers more. That is isotropic in the end.
    EXPECT_EQ(footprintReads({8.0, 0.0}, {0.0, 2.0}, 9.0, 2.0).reads, 2);
    EXPECT_NEAR(footprintReads({8.0, 0.0}, {0.0, 2.0}, 9.0, 2.0).level, 2.0, 1e-12);
    EXPECT_NEAR(footprintReads({8.0, 0.0}, {0.0, 2.0}, 9.0, 1.0).level, footprintLevel({8.0, 0.0}, {0.0, 2.0}, 9.0),
                1e-12);
}

TEST(Footprint, aShearedFootprintIsItsEllipse)
{
    // Both neighbours lie along one diagonal: long and thin, though both footprints are equally long.
    const FootprintReads r = footprintReads({4.0, 4.0}, {4.0, 3.0}, 9.0, 16.0);
    EXPECT_EQ(r.reads, 8);
    EXPECT_NEAR(r.level, 0.0, 1e-12) << "the shorter half axis is below a texel";
    EXPECT_GT(footprintLevel({4.0, 4.0}, {4.0, 3.0}, 9.0), 2.4);
    // The axes' squares sum to the footprints' squares.
    const double major = glm::length(r.step) * r.reads;
    const double minor = 4.0 / major;
    EXPECT_NEAR(major * major + minor * minor, 32.0 + 25.0, 1e-9);
}

TEST(Footprint, whatIsNoFootprintIsBounded)
{
    for (const double most : {2.0, 16.0, 1e9, kNan, -3.0}) {
        for (const double a : {0.0, kNan, kInfinity, -kInfinity, 1e30, -1e300, 1e-300}) {
            for (const double b : {0.0, kNan, kInfinity, 1e30, 2.0}) {
                const FootprintReads r = footprintReads({a, b}, {b, a}, 5.0, std::isnan(most) ? 16.0 : most);
                EXPECT_GE(r.reads, 1);
                EXPECT_LE(r.reads, kMostReads);
                EXPECT_GE(r.level, 0.0);
                EXPECT_LE(r.level, 5.0);
                EXPECT_TRUE(std::isfinite(r.step.x) && std::isfinite(r.step.y));
                const double level = footprintLevel({a, b}, {b, a}, 5.0);
                EXPECT_GE(level, 0.0);
                EXPECT_LE(level, 5.0);
            }
        }
    }
    EXPECT_EQ(footprintReads({0.0, 0.0}, {0.0, 0.0}, 5.0, 8.0).reads, 1);
    EXPECT_EQ(footprintReads({0.0, 0.0}, {0.0, 0.0}, 5.0, 8.0).level, 0.0);
    EXPECT_EQ(footprintLevel({kNan, 0.0}, {0.0, 0.0}, 5.0), 5.0) << "nothing known: as wide as can be";
    EXPECT_EQ(footprintLevel({kInfinity, 0.0}, {0.0, 1.0}, 5.0), 5.0);
    EXPECT_EQ(footprintLevel({8.0, 0.0}, {0.0, 8.0}, -1.0), 0.0) << "a map without levels";
}

class Sampling : public testing::Test {
protected:
    Sampling() : image(64, 64)
    {
        std::uniform_real_distribution<double> u(0.0, 1.0);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                image.at(x, y) = {u(rng), u(rng), u(rng), u(rng)};
            }
        }
        image.makeMips(5);
        test::map_moments = [this](glm::dvec2 texel, double level, double layer) {
            ++reads;
            return image.read(texel, level, layer);
        };
        input.tile = {0.0, 0.0, 64.0, 64.0};
        input.coarsest = 4.0;
        input.moments.anisotropy = 8.0;
        input.footprint_x = {1.0, 0.0};
        input.footprint_y = {0.0, 1.0};
        point.texel = {20.3, 33.9};
    }
    glm::dvec4 sample(int sampling)
    {
        input.moments.sampling = sampling;
        reads = 0;
        return sampleMoments(point, input, 0.0);
    }

    std::mt19937 rng{11};
    test::MomentImage image;
    MapPoint point{};
    FilterInput input{};
    int reads = 0;
};

TEST_F(Sampling, nearestIsTheTexelAndBilinearTheFourAround)
{
    input.footprint_x = {16.0, 0.0}; // neither looks at it
    EXPECT_EQ(sample(0), image.at(20, 33));
    const glm::dvec4 low = image.at(19, 33) * 0.2 + image.at(20, 33) * 0.8;
    const glm::dvec4 high = image.at(19, 34) * 0.2 + image.at(20, 34) * 0.8;
    EXPECT_LT(glm::length(sample(1) - (low * 0.6 + high * 0.4)), 1e-12);
}

TEST_F(Sampling, trilinearBlendsTheLevelsOfTheFootprint)
{
    EXPECT_LT(glm::length(sample(2) - image.read(point.texel, 0.0, 0.0)), 1e-12);
    input.footprint_y = {0.0, 4.0};
    point.texel = {22.0, 34.0}; // centre of a texel of level 2, which is the mean of its sixteen
    glm::dvec4 mean(0.0);
    for (int i = 0; i < 16; ++i) {
        mean += image.at(20 + i % 4, 32 + i / 4) / 16.0;
    }
    EXPECT_LT(glm::length(sample(2) - mean), 1e-12);
    input.footprint_y = {0.0, 3.0};
    const double part = std::log2(3.0) - 1.0;
    const glm::dvec4 expected = image.read(point.texel, 1.0, 0.0) * (1.0 - part) + mean * part;
    EXPECT_LT(glm::length(sample(2) - expected), 1e-12);
}

TEST_F(Sampling, anisotropicCoversTheLongerSideAlone)
{
    input.footprint_x = {4.0, 0.0};
    point.texel = {22.0, 33.5};
    glm::dvec4 row(0.0); // four texels of one row: nothing of the rows beside them
    for (int i = 0; i < 4; ++i) {
        row += image.at(20 + i, 33) / 4.0;
    }
    EXPECT_LT(glm::length(sample(3) - row), 1e-12);
    EXPECT_EQ(reads, 4);
    EXPECT_GT(glm::length(sample(2) - row), 1e-3) << "trilinear blurs across";
    input.footprint_x = {1e9, 0.0};
    static_cast<void>(sample(3));
    EXPECT_LE(reads, 8);
}

TEST_F(Sampling, neverReadsATexelOfAnotherTile)
{
    input.tile = {16.0, 32.0, 32.0, 48.0};
    test::MomentImage marked(64, 64, 1, glm::dvec4(1.0));
    for (int y = 32; y < 48; ++y) {
        for (int x = 16; x < 32; ++x) {
            marked.at(x, y) = glm::dvec4(0.0);
        }
    }
    marked.makeMips(5);
    test::map_moments = [&](glm::dvec2 texel, double level, double layer) {
        return marked.read(texel, level, layer);
    };
    std::uniform_real_distribution<double> place(0.0, 64.0);
    std::uniform_real_distribution<double> footprint(-30.0, 30.0);
    for (int i = 0; i < 4000; ++i) {
        point.texel = {place(rng), place(rng)};
        input.footprint_x = {footprint(rng), footprint(rng)};
        input.footprint_y = {footprint(rng), footprint(rng)};
        EXPECT_EQ(sample(i % 4), glm::dvec4(0.0));
    }
    input.tile = {0.0, 0.0, 64.0, 64.0};
    point.texel = {16.0, 40.0};
    EXPECT_GT(sample(1).x, 0.4) << "the marks can be seen";
}

} // namespace
} // namespace gnomon::shared
