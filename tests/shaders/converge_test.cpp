// SPDX-License-Identifier: Apache-2.0
// Means over frames, and where they end, in double precision.
#define GNOMON_REAL double
#include <gnomon/shared/converge.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace gnomon::shared {
namespace {

double hashed(std::uint64_t n)
{
    n = (n + 1) * 0x9E3779B97F4A7C15U;
    n = (n ^ (n >> 30)) * 0xBF58476D1CE4E5B9U;
    n = (n ^ (n >> 27)) * 0x94D049BB133111EBU;
    return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1.0p-53;
}

TEST(JoinedMean, growingIsTheArithmeticMean)
{
    double mean = 0.0;
    double sum = 0.0;
    for (int frame = 0; frame < 64; ++frame) {
        const double now = hashed(static_cast<std::uint64_t>(frame));
        sum += now;
        mean = joinedMean(mean, double(frame), now, 1.0);
        EXPECT_NEAR(mean, sum / (frame + 1), 1e-14);
    }
}

TEST(JoinedMean, heldForgetsByEqualShares)
{
    constexpr double kHeld = 3.0;
    double mean = 1.0;
    for (int frame = 1; frame < 30; ++frame) {
        mean = joinedMean(mean, kHeld, 0.0, 1.0);
        EXPECT_NEAR(mean, std::pow(kHeld / (kHeld + 1.0), frame), 1e-14);
    }
    EXPECT_EQ(joinedMean(0.7, 0.0, 0.25, 1.0), 0.25) << "of no frames this one is left";
}

TEST(JoinedMean, weighsWhatItJoins)
{
    double mean = 0.0;
    double sum = 0.0;
    double weights = 0.0;
    for (int frame = 0; frame < 64; ++frame) {
        const double now = hashed(static_cast<std::uint64_t>(frame));
        const double weight = 0.01 + 9.0 * hashed(static_cast<std::uint64_t>(1000 + frame));
        mean = joinedMean(mean, weights, now, weight);
        sum += weight * now;
        weights += weight;
        EXPECT_NEAR(mean, sum / weights, 1e-13);
    }
}

TEST(FrameWeight, isOneOnTheMeanOverATexel)
{
    constexpr int kSteps = 400;
    for (const double stood : {0.0, 1.0, 7.0, 30.0, 1000.0}) {
        double sum = 0.0;
        for (int i = 0; i < kSteps * kSteps; ++i) {
            const real2 place(-3.0 + (i % kSteps + 0.5) / kSteps, 5.0 + (i / kSteps + 0.5) / kSteps);
            sum += frameWeight(texelConfidence(place), confidencePower(stood, kMostOfWholeLight));
        }
        EXPECT_NEAR(sum / (kSteps * kSteps), 1.0, 1e-3) << stood;
    }
    EXPECT_EQ(confidencePower(0.0, kMostOfPoint), 0.0) << "the first frame is as it is without";
    EXPECT_EQ(frameWeight(0.2, 0.0), 1.0);
    EXPECT_EQ(confidencePower(1000.0, kMostOfPoint), kMostOfPoint);
    EXPECT_EQ(texelConfidence(real2(-3.5, 7.5)), 1.0);
    EXPECT_EQ(texelConfidence(real2(-3.5, 7.0)), 0.0);
    EXPECT_NEAR(texelConfidence(real2(2.75, 7.4)), 0.5, 1e-12);
}

// Half floats have eleven bits.
TEST(PackSeen, keepsVisibilityAndWeightInAHalfFloat)
{
    const auto half = [](double value) {
        const double step = std::exp2(std::floor(std::log2(std::max(std::abs(value), 1e-4))) - 10.0);
        return std::round(value / step) * step;
    };
    for (int v = 0; v <= 255; ++v) {
        for (int c = 0; c <= 32; ++c) {
            const double seen = half(packSeen(v / 255.0, c / 32.0));
            const real2 found = unpackSeen(seen, 3.0);
            EXPECT_LE(seen, 1.0) << "the least of a channel's draws is kept";
            EXPECT_NEAR(found.x, v / 255.0, std::abs(seen) / 1024.0 + 1e-12);
            const double from = frameWeight(std::max(c / 32.0 - 1.0 / 8.0, 0.0), 3.0);
            const double to = frameWeight(std::min(c / 32.0 + 1.0 / 8.0, 1.0), 3.0);
            EXPECT_TRUE(found.y > 0.0 && found.y >= from && found.y <= to) << c;
        }
    }
    EXPECT_EQ(unpackSeen(0.3, 3.0), real2(0.3, 1.0)) << "what is not packed";
    EXPECT_EQ(unpackSeen(0.0, 3.0), real2(0.0, 1.0));
    EXPECT_EQ(unpackSeen(1.0, 3.0), real2(1.0, 1.0));
}

TEST(PackCount, tellsSmallWeightsApart)
{
    double before = -1.0;
    for (int packed = 0; packed < 256; ++packed) {
        const double count = unpackCount(double(packed));
        EXPECT_EQ(packCount(count), double(packed));
        EXPECT_GT(count, before);
        before = count;
    }
    EXPECT_EQ(before, 64.0);
    EXPECT_EQ(packCount(1e9), 255.0);
    EXPECT_GT(packCount(frameWeight(1.0 / 16.0, 3.0)), 0.0) << "a frame that hardly counts is not none";
}

TEST(MostInMotion, isLittleAtSharpEdgesAlone)
{
    EXPECT_EQ(mostInMotion(1.0, kLeastOfPoint), 3.0);
    EXPECT_EQ(mostInMotion(0.0, kLeastOfPoint), 15.0);
    EXPECT_NEAR(mostInMotion(0.3, kLeastOfPoint), 0.6 / 0.09, 1e-12);
    EXPECT_NEAR(mostInMotion(1.0, kLeastOfWholeLight), 0.0, 1e-12) << "a sharp edge is this frame's";
    EXPECT_NEAR(mostInMotion(0.3, kLeastOfWholeLight), 0.6 / 0.09 - 0.6, 1e-12);
    EXPECT_EQ(mostInMotion(0.0, kLeastOfWholeLight), 15.0);
}

TEST(CubicWeights, keepConstantsLinesAndParabolas)
{
    for (double part = 0.0; part <= 1.0; part += 0.125) {
        const real4 w = cubicWeights(part);
        EXPECT_NEAR(w.x + w.y + w.z + w.w, 1.0, 1e-15);
        EXPECT_NEAR(-w.x + w.z + 2.0 * w.w, part, 1e-15);
        EXPECT_NEAR(w.x + w.z + 4.0 * w.w, part * part, 1e-15);
    }
    EXPECT_EQ(cubicWeights(0.0), real4(0.0, 1.0, 0.0, 0.0));
    EXPECT_EQ(cubicWeights(1.0), real4(0.0, 0.0, 1.0, 0.0));
}

bool meetsBox(const real3& p, const real3& to, const real3& centre, const real3& extent)
{
    for (int i = 0; i <= 2000; ++i) {
        const real3 off = abs(p + (to - p) * (i / 2000.0) - centre);
        if (off.x <= extent.x && off.y <= extent.y && off.z <= extent.z) {
            return true;
        }
    }
    return false;
}

// Whatever point of the light a box hides, it may shadow. Far from that it may not.
TEST(MayShadow, isSaidWhereABoxHidesAPartOfTheLight)
{
    int hidden = 0;
    int clear = 0;
    for (std::uint64_t i = 0; i < 8000; ++i) {
        const auto number = [&](std::uint64_t k) {
            return hashed(100 * i + k) * 2.0 - 1.0;
        };
        const bool parallel = i % 2 == 0;
        const real3 p(number(0) * 4.0, number(1) * 4.0, number(2) * 4.0);
        const real3 centre(number(3) * 4.0, number(4) * 4.0, number(5) * 4.0);
        const real3 extent = real3(0.6) + real3(number(6), number(7), number(8)) * 0.5;
        const double size = parallel ? 0.1 : 0.5;
        const real3 light = parallel ? normalize(real3(number(9), number(10), number(11)))
                                     : real3(number(9) * 8.0, 9.0, number(11) * 8.0);
        const real4 place(light.x, light.y, light.z, parallel ? 0.0 : 1.0);
        // A point of the light: beside its middle by its size at most.
        const real3 aside = normalize(real3(number(12), number(13), number(14))) * (hashed(100 * i + 15) * size);
        const real3 to = parallel ? p + (light + aside - light * dot(light, aside)) * 30.0 : light + aside;
        const bool may = mayShadow(centre, extent, p, place, size, 0.0);
        if (meetsBox(p, to, centre, extent)) {
            EXPECT_TRUE(may) << i;
            ++hidden;
        } else if (!may) {
            ++clear;
        }
    }
    EXPECT_GT(hidden, 100);
    EXPECT_GT(clear, 1000) << "else it could say so of everything";
}

TEST(MayShadow, knowsBehindAndBeside)
{
    const real4 up(0.0, 1.0, 0.0, 0.0);
    const real3 extent(0.5);
    EXPECT_TRUE(mayShadow(real3(0.0, 5.0, 0.0), extent, real3(0.0), up, 0.0, 0.0));
    EXPECT_FALSE(mayShadow(real3(0.0, -5.0, 0.0), extent, real3(0.0), up, 0.0, 0.0)) << "under the point";
    EXPECT_FALSE(mayShadow(real3(0.6, 5.0, 0.0), extent, real3(0.0), up, 0.0, 0.0));
    EXPECT_TRUE(mayShadow(real3(0.6, 5.0, 0.0), extent, real3(0.0), up, 0.0, 0.2)) << "within the filter's reach";
    EXPECT_TRUE(mayShadow(real3(0.6, 5.0, 0.0), extent, real3(0.0), up, 0.05, 0.0)) << "within the penumbra";
    EXPECT_TRUE(mayShadow(real3(0.2, 0.1, 0.0), extent, real3(0.0), up, 0.0, 0.0)) << "the box holds the point";
    const real4 lamp(0.0, 3.0, 0.0, 1.0);
    EXPECT_FALSE(mayShadow(real3(0.0, 5.0, 0.0), extent, real3(0.0), lamp, 0.1, 0.0)) << "behind the lamp";
    EXPECT_TRUE(mayShadow(real3(0.0, 2.0, 0.0), extent, real3(0.0), lamp, 0.1, 0.0));
}

} // namespace
} // namespace gnomon::shared
