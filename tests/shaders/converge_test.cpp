// SPDX-License-Identifier: Apache-2.0
// Means over frames, and where they end, in double precision.
#define GNOMON_REAL double
#include <shared/converge.h>

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
        mean = joinedMean(mean, double(frame), now);
        EXPECT_NEAR(mean, sum / (frame + 1), 1e-14);
    }
}

TEST(JoinedMean, heldForgetsByEqualShares)
{
    constexpr double kHeld = 3.0;
    double mean = 1.0;
    for (int frame = 1; frame < 30; ++frame) {
        mean = joinedMean(mean, kHeld, 0.0);
        EXPECT_NEAR(mean, std::pow(kHeld / (kHeld + 1.0), frame), 1e-14);
    }
    EXPECT_EQ(joinedMean(0.7, 0.0, 0.25), 0.25) << "of no frames this one is left";
}

TEST(MostInMotion, isLittleAtSharpEdgesAlone)
{
    EXPECT_EQ(mostInMotion(1.0), 3.0);
    EXPECT_EQ(mostInMotion(0.0), 15.0);
    EXPECT_NEAR(mostInMotion(0.3), 0.6 / 0.09, 1e-12);
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
