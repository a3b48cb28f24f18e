// SPDX-License-Identifier: Apache-2.0
#include "lab/metrics/error_classes.h"

#include "masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lab {
namespace {

using test::constantMask;

constexpr float kNowhere = std::numeric_limits<float>::infinity();
constexpr double kDiagonal_m = 100.0; // contact reaches to 1 m

/// 64 x 48: umbra left of column 32, lit right of it; the blocker of the umbra is 0.5 m off in the upper half, 20 m in
/// the lower one.
struct Drawing {
    ImageF truth{64, 48, 1, 1.0F};
    ImageF test;
    Counted counted = countAll(64, 48);
    Counted terminator{64, 48, 1};
    ImageF first_blocker_m{64, 48, 1, kNowhere};

    Drawing()
    {
        for (std::uint32_t y = 0; y < 48; ++y) {
            std::fill_n(truth.pixel(0, y), 32, 0.0F);
            std::fill_n(first_blocker_m.pixel(0, y), 32, y < 24 ? 0.5F : 20.0F);
        }
        test = truth;
    }
    [[nodiscard]] Classification classify() const
    {
        return classifyErrors(test, truth, counted, terminator, first_blocker_m, kDiagonal_m).value();
    }
    [[nodiscard]] double meanSquare() const
    {
        const double rmse = errorNumbers(test, truth, counted).value().rmse;
        return rmse * rmse;
    }
};

double sumOf(const ClassErrors& errors)
{
    return errors.edge + errors.acne + errors.detached + errors.bleeding + errors.terminator;
}

std::ptrdiff_t countOf(const Classification& result, ErrorClass kind)
{
    return std::count(result.classes.values.begin(), result.classes.values.end(), kind);
}

TEST(ErrorClasses, EachArtefactMovesItsOwnClassOnly)
{
    struct Case {
        std::uint32_t x;
        std::uint32_t y;
        float value;
        double ClassErrors::*error;
        ErrorClass kind;
    };
    for (const Case& c : {
             Case{50, 10, 0.25F, &ClassErrors::acne, ErrorClass::acne},
             Case{36, 40, 0.75F, &ClassErrors::acne, ErrorClass::acne},
             Case{10, 10, 0.5F, &ClassErrors::detached, ErrorClass::detached},
             Case{10, 40, 0.5F, &ClassErrors::bleeding, ErrorClass::bleeding},
             Case{27, 40, 1.0F, &ClassErrors::bleeding, ErrorClass::bleeding},
             Case{28, 10, 1.0F, &ClassErrors::edge, ErrorClass::edge},
             Case{31, 40, 0.5F, &ClassErrors::edge, ErrorClass::edge},
             Case{35, 10, 0.0F, &ClassErrors::edge, ErrorClass::edge},
         }) {
        Drawing drawing;
        *drawing.test.pixel(c.x, c.y) = c.value;
        const Classification result = drawing.classify();
        const double e = c.value - *drawing.truth.pixel(c.x, c.y);
        ClassErrors expected;
        expected.*c.error = e * e / (64.0 * 48.0);
        EXPECT_DOUBLE_EQ(result.errors.edge, expected.edge) << c.x << "," << c.y;
        EXPECT_DOUBLE_EQ(result.errors.acne, expected.acne) << c.x << "," << c.y;
        EXPECT_DOUBLE_EQ(result.errors.detached, expected.detached) << c.x << "," << c.y;
        EXPECT_DOUBLE_EQ(result.errors.bleeding, expected.bleeding) << c.x << "," << c.y;
        EXPECT_EQ(*result.classes.pixel(c.x, c.y), c.kind) << c.x << "," << c.y;
        EXPECT_EQ(countOf(result, ErrorClass::edge), 8 * 48);
        EXPECT_EQ(countOf(result, ErrorClass::correct), 56 * 48 - (c.kind == ErrorClass::edge ? 0 : 1));
    }
}

TEST(ErrorClasses, ContactEndsAtItsShareOfTheDiagonal)
{
    Drawing drawing;
    *drawing.test.pixel(10, 10) = 1.0F;
    const auto classAt = [&](float distance_m) {
        *drawing.first_blocker_m.pixel(10, 10) = distance_m;
        return *drawing.classify().classes.pixel(10, 10);
    };
    EXPECT_EQ(classAt(0.0F), ErrorClass::detached);
    EXPECT_EQ(classAt(std::nextafter(1.0F, 0.0F)), ErrorClass::detached);
    EXPECT_EQ(classAt(1.0F), ErrorClass::bleeding);
    EXPECT_EQ(classAt(kNowhere), ErrorClass::bleeding);
}

TEST(ErrorClasses, OnePixelOfPenumbraReachesThreePixels)
{
    const ImageF blockers = constantMask(31, 21, kNowhere);
    // Next to 1, too little of a step for an edge: it is the penumbra that reaches.
    for (const float value : {0.999F, 0.75F}) {
        ImageF truth = constantMask(31, 21, 1.0F);
        *truth.pixel(12, 9) = value;
        const auto result = classifyErrors(truth, truth, countAll(31, 21), Counted(31, 21, 1), blockers, kDiagonal_m);
        ASSERT_TRUE(result);
        for (int y = 0; y < 21; ++y) {
            for (int x = 0; x < 31; ++x) {
                const bool near = std::abs(x - 12) <= 3 && std::abs(y - 9) <= 3;
                EXPECT_EQ(*result->classes.pixel(x, y), near ? ErrorClass::edge : ErrorClass::correct) << x << "," << y;
            }
        }
    }
}

TEST(ErrorClasses, EdgesRunToEveryNeighbourAndStopAtTheBorder)
{
    // One dark pixel: with its 8 neighbours it makes 3 x 3 edge pixels, which reach 3 more.
    const ImageF blockers = constantMask(31, 21, 1.0F);
    struct Place {
        int x;
        int y;
    };
    for (const Place& p : {Place{15, 10}, Place{0, 0}, Place{30, 0}, Place{0, 20}, Place{30, 20}, Place{29, 5}}) {
        ImageF truth = constantMask(31, 21, 1.0F);
        *truth.pixel(p.x, p.y) = 0.0F;
        const auto result = classifyErrors(truth, truth, countAll(31, 21), Counted(31, 21, 1), blockers, kDiagonal_m);
        ASSERT_TRUE(result);
        for (int y = 0; y < 21; ++y) {
            for (int x = 0; x < 31; ++x) {
                const bool near = std::abs(x - p.x) <= 4 && std::abs(y - p.y) <= 4;
                EXPECT_EQ(*result->classes.pixel(x, y), near ? ErrorClass::edge : ErrorClass::correct) << x << "," << y;
            }
        }
    }
}

TEST(ErrorClasses, DiagonalNeighboursMakeAnEdge)
{
    // Only the pixels (5, 5) and its diagonal neighbour count, in each of the four directions.
    struct Place {
        std::uint32_t x;
        std::uint32_t y;
    };
    for (const Place& p : {Place{6, 6}, Place{4, 6}, Place{6, 4}, Place{4, 4}}) {
        ImageF truth = constantMask(11, 11, 1.0F);
        *truth.pixel(5, 5) = 0.0F;
        Counted counted(11, 11, 1);
        *counted.pixel(5, 5) = 1;
        *counted.pixel(p.x, p.y) = 1;
        const auto result =
            classifyErrors(truth, truth, counted, Counted(11, 11, 1), constantMask(11, 11, kNowhere), kDiagonal_m);
        ASSERT_TRUE(result);
        EXPECT_EQ(countOf(*result, ErrorClass::edge), 2);
        EXPECT_EQ(countOf(*result, ErrorClass::left_out), 119);
    }
}

TEST(ErrorClasses, PixelsThatDoNotCountMakeNoEdge)
{
    Drawing drawing;
    for (std::uint32_t y = 0; y < 48; ++y) {
        *drawing.counted.pixel(31, y) = 0; // between umbra and light: no two counted neighbours differ
        *drawing.truth.pixel(31, y) = 0.5F;
        *drawing.test.pixel(32, y) = 0.5F;
        *drawing.test.pixel(31, y) = 1.0F;
    }
    const Classification result = drawing.classify();
    EXPECT_EQ(countOf(result, ErrorClass::edge), 0);
    EXPECT_EQ(countOf(result, ErrorClass::left_out), 48);
    EXPECT_EQ(countOf(result, ErrorClass::acne), 48);
    EXPECT_DOUBLE_EQ(result.errors.acne, 0.25 * 48.0 / (63.0 * 48.0));
    EXPECT_EQ(result.errors.edge, 0.0);
}

TEST(ErrorClasses, ReachGoesOverPixelsThatDoNotCount)
{
    Drawing drawing;
    for (std::uint32_t y = 0; y < 48; ++y) {
        *drawing.counted.pixel(34, y) = 0;
    }
    const Classification result = drawing.classify();
    EXPECT_EQ(*result.classes.pixel(34, 20), ErrorClass::left_out);
    EXPECT_EQ(*result.classes.pixel(35, 20), ErrorClass::edge);
    EXPECT_EQ(*result.classes.pixel(36, 20), ErrorClass::correct);
}

TEST(ErrorClasses, AStepOfAHalfIsNoEdge)
{
    // Truths beyond 0 and 1 are no penumbra, which alone would mark them.
    ImageF truth(9, 9, 1, 1.5F);
    std::fill_n(truth.values.begin(), 36, 1.0F);
    const ImageF blockers = constantMask(9, 9, kNowhere);
    EXPECT_EQ(countOf(*classifyErrors(truth, truth, countAll(9, 9), Counted(9, 9, 1), blockers, kDiagonal_m),
                      ErrorClass::edge),
              0);
    for (float& value : truth.values) {
        value = value > 1.0F ? std::nextafter(1.5F, 2.0F) : value;
    }
    EXPECT_EQ(countOf(*classifyErrors(truth, truth, countAll(9, 9), Counted(9, 9, 1), blockers, kDiagonal_m),
                      ErrorClass::edge),
              8 * 9);
}

TEST(ErrorClasses, NanGoesByItsPlaceAndIsNotHidden)
{
    struct Case {
        std::uint32_t x;
        std::uint32_t y;
        double ClassErrors::*error;
        ErrorClass kind;
    };
    for (const Case& c : {
             Case{50, 10, &ClassErrors::acne, ErrorClass::acne},
             Case{10, 10, &ClassErrors::detached, ErrorClass::detached},
             Case{10, 40, &ClassErrors::bleeding, ErrorClass::bleeding},
             Case{32, 10, &ClassErrors::edge, ErrorClass::edge},
         }) {
        Drawing drawing;
        *drawing.test.pixel(c.x, c.y) = std::numeric_limits<float>::quiet_NaN();
        const Classification result = drawing.classify();
        EXPECT_EQ(*result.classes.pixel(c.x, c.y), c.kind);
        EXPECT_TRUE(std::isnan(result.errors.*c.error));
        int nans = 0;
        for (const double error :
             {result.errors.edge, result.errors.acne, result.errors.detached, result.errors.bleeding}) {
            nans += std::isnan(error) ? 1 : 0;
        }
        EXPECT_EQ(nans, 1);
    }
}

TEST(ErrorClasses, NanInTruthOrBlockersHasAClassToo)
{
    Drawing drawing;
    *drawing.truth.pixel(10, 10) = std::numeric_limits<float>::quiet_NaN();
    *drawing.test.pixel(10, 40) = 1.0F;
    *drawing.first_blocker_m.pixel(10, 40) = std::numeric_limits<float>::quiet_NaN();
    const Classification result = drawing.classify();
    EXPECT_EQ(*result.classes.pixel(10, 10), ErrorClass::detached);
    EXPECT_EQ(*result.classes.pixel(10, 40), ErrorClass::bleeding);
    EXPECT_EQ(countOf(result, ErrorClass::left_out), 0);
}

TEST(ErrorClasses, NothingWhenNoPixelCounts)
{
    const ImageF mask = constantMask(9, 9, 0.5F);
    EXPECT_FALSE(classifyErrors(mask, mask, Counted(9, 9, 1), Counted(9, 9, 1), mask, kDiagonal_m));
    const ImageF empty(0, 0, 1);
    EXPECT_FALSE(classifyErrors(empty, empty, countAll(0, 0), Counted(0, 0, 1), empty, kDiagonal_m));
    EXPECT_FALSE(
        classifyErrors(mask, mask, Counted(9, 9, 1), Counted(9, 9, 1), mask, 0.0)); // a scene of nothing has no size
}

/// Blobs of umbra and penumbra with errors of every size, some beyond [0, 1], some pixels left out.
Drawing randomDrawing(std::uint64_t seed)
{
    test::Random random(seed);
    Drawing drawing;
    std::fill(drawing.truth.values.begin(), drawing.truth.values.end(), 1.0F);
    for (int blob = 0; blob < 4; ++blob) {
        const double x0 = 64.0 * random.uniform();
        const double y0 = 48.0 * random.uniform();
        const double radius = 2.0 + 12.0 * random.uniform();
        const double softness = random.below(2) == 0 ? 1e-9 : 3.0;
        for (std::uint32_t y = 0; y < 48; ++y) {
            for (std::uint32_t x = 0; x < 64; ++x) {
                const double away = (std::hypot(x - x0, y - y0) - radius) / softness;
                float& value = *drawing.truth.pixel(x, y);
                value = std::min(value, static_cast<float>(std::clamp(away, 0.0, 1.0)));
            }
        }
    }
    for (std::size_t i = 0; i < drawing.test.values.size(); ++i) {
        const bool errs = random.below(3) == 0;
        const auto other = static_cast<float>(1.2 * random.uniform() - 0.1);
        drawing.test.values[i] = errs ? other : drawing.truth.values[i];
        drawing.counted.values[i] = random.below(10) != 0 ? 1 : 0;
        drawing.terminator.values[i] = drawing.counted.values[i] != 0 && random.below(10) == 0 ? 1 : 0;
        drawing.first_blocker_m.values[i] = static_cast<float>(4.0 * random.uniform());
    }
    return drawing;
}

TEST(ErrorClasses, TheTerminatorIsAClassOfItsOwnAndMakesNoEdge)
{
    // A column of it between umbra and light, and one on the lit side, where the truth is dark once.
    Drawing drawing;
    for (std::uint32_t y = 0; y < 48; ++y) {
        for (const std::uint32_t x : {31U, 32U, 60U}) {
            *drawing.terminator.pixel(x, y) = 1;
        }
        *drawing.truth.pixel(60, y) = 0.0F;
        *drawing.test.pixel(60, y) = 1.0F;
        *drawing.test.pixel(61, y) = 0.0F;
    }
    const Classification result = drawing.classify();
    EXPECT_EQ(countOf(result, ErrorClass::terminator), 3 * 48);
    EXPECT_EQ(countOf(result, ErrorClass::edge), 0);
    EXPECT_EQ(countOf(result, ErrorClass::acne), 48);
    EXPECT_NEAR(result.errors.terminator, 1.0 / 64.0, 1e-12);
    EXPECT_NEAR(result.errors.acne, 1.0 / 64.0, 1e-12);
    EXPECT_NEAR(sumOf(result.errors), drawing.meanSquare(), 1e-12);
}

TEST(ErrorClasses, RandomMasksAddUpAndEveryCountedPixelHasAClass)
{
    std::ptrdiff_t seen[7] = {};
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const Drawing drawing = randomDrawing(seed);
        const Classification result = drawing.classify();
        EXPECT_NEAR(sumOf(result.errors), drawing.meanSquare(), 1e-12) << seed;
        for (std::size_t i = 0; i < drawing.counted.values.size(); ++i) {
            const ErrorClass kind = result.classes.values[i];
            ASSERT_EQ(kind == ErrorClass::left_out, drawing.counted.values[i] == 0) << seed << " " << i;
            ASSERT_EQ(kind == ErrorClass::terminator, drawing.terminator.values[i] != 0) << seed << " " << i;
            ASSERT_TRUE(kind != ErrorClass::correct || drawing.test.values[i] == drawing.truth.values[i]);
            ++seen[static_cast<int>(kind)];
        }
    }
    for (const std::ptrdiff_t pixels : seen) {
        EXPECT_GT(pixels, 100); // the drawings are worth their name: no class goes without
    }
}

TEST(ErrorClasses, WhatDoesNotCountChangesNothing)
{
    for (std::uint64_t seed = 60; seed < 70; ++seed) {
        Drawing drawing = randomDrawing(seed);
        const Classification before = drawing.classify();
        test::Random random(seed);
        for (std::size_t i = 0; i < drawing.counted.values.size(); ++i) {
            if (drawing.counted.values[i] == 0) {
                drawing.test.values[i] = std::numeric_limits<float>::quiet_NaN();
                drawing.truth.values[i] = static_cast<float>(random.uniform());
                drawing.first_blocker_m.values[i] = 0.0F;
            }
        }
        const Classification after = drawing.classify();
        EXPECT_EQ(before.classes.values, after.classes.values);
        EXPECT_EQ(sumOf(before.errors), sumOf(after.errors));
    }
}

} // namespace
} // namespace gnomon::lab
