// SPDX-License-Identifier: Apache-2.0
// Fins against closed forms: which edges have one, how far and how deep the edge is, and alpha over a fin.
#include "cpu_map.h"

#include <gnomon/shared/smoothie_fins.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace gnomon::shared {
namespace {

constexpr double kReach = 16.0;

/// A point as fin.vert sees it: x, y and w of clip space, and the map's depth.
struct Seen {
    real3 clip;
    double depth;
};

/// A sun from straight above, or a lamp at `lamp_m` above the origin. A metre is 8 texels, or 8 at 10 m from the lamp.
Seen see(const real3& p, double lamp_m)
{
    constexpr double kTexels = 8.0;
    if (lamp_m <= 0.0) {
        return {{p.x * kTexels, p.y * kTexels, 1.0}, 0.9 - 0.05 * p.z};
    }
    return {{p.x * kTexels * 10.0, p.y * kTexels * 10.0, lamp_m - p.z}, 0.9 - 0.05 * p.z};
}

real2 texelOf(const Seen& seen)
{
    return real2(seen.clip.x, seen.clip.y) / seen.clip.z;
}

/// The fin of an edge whose caster lies on the side of `inside`.
Fin finOf(const real3& a, const real3& b, const real3& inside, double lamp_m)
{
    const Seen from = see(a, lamp_m);
    const Seen to = see(b, lamp_m);
    const double side = finSide(from.clip, to.clip - from.clip, see(inside, lamp_m).clip - from.clip);
    return {texelOf(from), texelOf(to), finOutward(texelOf(from), texelOf(to), side), from.depth, to.depth,
            from.clip.z,   to.clip.z};
}

TEST(SmoothieFins, AreAlongEdgesBetweenWhatFacesTheLightAndWhatDoesNot)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> spread(-1.0, 1.0);
    const auto anywhere = [&] {
        return real3(spread(random), spread(random), spread(random));
    };
    int silhouettes = 0;
    for (int i = 0; i < 10000; ++i) {
        const real3 a = anywhere();
        const real3 b = anywhere();
        const real3 left = anywhere();
        const real3 right = anywhere();
        for (const double lamp_m : {0.0, 3.0}) {
            const real3 toward_a = lamp_m > 0.0 ? real3(0.0, 0.0, lamp_m) - a : real3(0.0, 0.0, 1.0);
            const bool left_faces = dot(cross(b - a, left - a), toward_a) > 0.0;
            const bool right_faces = dot(cross(a - b, right - b), toward_a) > 0.0;
            const Seen from = see(a, lamp_m);
            const real3 along = see(b, lamp_m).clip - from.clip;
            const double of_left = finSide(from.clip, along, see(left, lamp_m).clip - from.clip);
            const double of_right = finSide(from.clip, along, see(right, lamp_m).clip - from.clip);
            EXPECT_EQ(isSilhouette(of_left, of_right), left_faces != right_faces);
            silhouettes += left_faces != right_faces ? 1 : 0;
        }
    }
    EXPECT_GT(silhouettes, 5000);
    EXPECT_TRUE(isSilhouette(2.0, 2.0)) << "an edge of one triangle";
    EXPECT_TRUE(isSilhouette(2.0, 0.0)) << "a wall that the light grazes";
    EXPECT_FALSE(isSilhouette(0.0, 0.0)) << "nothing that the light sees";
}

TEST(SmoothieFins, LieOutsideOfTheCaster)
{
    for (const double inside : {-1.0, 1.0}) {
        const Fin fin = finOf({-2.0, 0.0, 1.0}, {2.0, 0.0, 1.0}, {0.5, inside, 1.0}, 0.0);
        EXPECT_NEAR(fin.outward.y, -inside, 1e-12);
        EXPECT_TRUE(isBehindFin(fin, {3.0, inside}));
        EXPECT_FALSE(isBehindFin(fin, {3.0, -inside}));
    }
}

TEST(SmoothieFins, CoverAllThatIsNearerThanTheReachOnTheirSide)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> spread(-40.0, 40.0);
    const auto anywhere = [&] {
        return real2(spread(random), spread(random));
    };
    int covered = 0;
    for (int i = 0; i < 20000; ++i) {
        Fin fin{};
        fin.from = anywhere();
        fin.to = i % 10 == 0 ? fin.from : anywhere();
        fin.outward = finOutward(fin.from, fin.to, i % 2 == 0 ? 1.0 : -1.0);
        const real2 p = anywhere();
        const double distance = finDistance(fin, p, finNearest(fin, p));
        if (distance > kReach || isBehindFin(fin, p)) {
            continue;
        }
        bool inside = false;
        for (const int first : {0, 3}) {
            std::array<real2, 3> corner{};
            for (int k = 0; k < 3; ++k) {
                corner[static_cast<std::size_t>(k)] = finCorner(first + k, fin.from, fin.to, fin.outward, kReach);
            }
            const auto area = [](const real2& a, const real2& b, const real2& c) {
                return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            };
            const double whole = area(corner[0], corner[1], corner[2]);
            inside = inside ||
                     (area(corner[0], corner[1], p) / whole >= -1e-9 &&
                      area(corner[1], corner[2], p) / whole >= -1e-9 && area(corner[2], corner[0], p) / whole >= -1e-9);
        }
        EXPECT_TRUE(inside);
        ++covered;
    }
    EXPECT_GT(covered, 1000);
}

/// An edge parallel to the receiver: alpha is 0 at it, 1 at the fin's end and grows evenly in between; beyond the
/// edge's ends it is round.
TEST(SmoothieFins, OverAReceiverParallelToTheEdgeAlphaGrowsEvenly)
{
    const Fin fin = finOf({-2.0, 0.0, 4.0}, {2.0, 0.0, 4.0}, {0.0, 1.0, 4.0}, 0.0);
    constexpr double kWidth = 10.0; // texels
    for (const double across : {0.0, 2.5, 5.0, 10.0, 12.0}) {
        for (const double along : {-16.0, -3.0, 0.0, 16.0}) {
            const real2 texel(along, -across);
            const double nearest = finNearest(fin, texel);
            const Smoothie s = unpackSmoothie(packSmoothie({finDepth(fin, nearest), finDistance(fin, texel, nearest)}));
            EXPECT_NEAR(smoothieAlpha(s.distance, kWidth, kReach), std::min(across / kWidth, 1.0), 1e-4);
            EXPECT_NEAR(s.depth, 0.7, 1e-5);
        }
    }
    const real2 beyond(16.0 + 3.0, -4.0); // the edge ends at texel 16
    EXPECT_NEAR(finDistance(fin, beyond, finNearest(fin, beyond)), 5.0, 1e-12);
}

/// Chan and Durand: alpha' = alpha / (1 - b / r), of a fin as wide as the lamp's radius, at depth b from the lamp.
TEST(SmoothieFins, UnderALampTheyAreThoseOfChanAndDurand)
{
    constexpr double kLamp = 10.0;
    constexpr double kRadius = 0.4; // m
    for (const double height : {1.0, 2.5, 5.0}) {
        const Fin fin = finOf({-2.0, 0.0, height}, {2.0, 0.0, height}, {0.0, 1.0, height}, kLamp);
        const double b = kLamp - height;
        const double fin_texels = kRadius / b * 80.0;
        // The width on the map, at the caster's depth, of the cone from the receiver to the light.
        const double width = kRadius * (1.0 - b / kLamp) / b * 80.0;
        for (double texels = 0.0; texels < 6.0; texels += 0.5) {
            const real2 at(0.3, -texels);
            const double distance = finDistance(fin, at, finNearest(fin, at));
            const double alpha = distance / fin_texels;
            EXPECT_NEAR(smoothieAlpha(distance, width, 100.0), std::min(alpha / (1.0 - b / kLamp), 1.0), 1e-12);
        }
    }
}

TEST(SmoothieFins, KnowHowDeepTheirEdgeIsWhereItIsNearest)
{
    constexpr double kLamp = 10.0;
    const real3 a(-2.0, 0.0, 1.0);
    const real3 b(2.0, 0.0, 8.0); // rises towards the lamp
    const Fin fin = finOf(a, b, {0.0, 1.0, 4.0}, kLamp);
    for (double t = 0.0; t <= 1.0; t += 0.1) {
        const Seen seen = see(mix(a, b, t), kLamp);
        const real2 beside = texelOf(seen) + 3.0 * fin.outward;
        EXPECT_NEAR(finDepth(fin, finNearest(fin, beside)), seen.depth, 1e-12) << t;
    }
}

TEST(SmoothieFins, AreCutWhereAnEdgePassesTheLight)
{
    EXPECT_DOUBLE_EQ(finCut(2.0, 3.0), 0.0);
    for (const double behind : {-5.0, -0.1, 0.001}) {
        const double cut = finCut(behind, 4.0);
        EXPECT_NEAR(mix(behind, 4.0, cut), 0.04, 1e-12);
    }
}

TEST(SmoothieFins, DoNotDarkenTheSurfaceThatTheyAreAnEdgeOf)
{
    constexpr double kQuantum = 4e-6;
    for (const double lean : {0.0, 0.001, 0.02}) {
        for (const double distance : {0.0, 1.0, 16.0}) {
            EXPECT_FALSE(isOverSurface(lean * distance, lean, distance, kQuantum)) << "its own";
            EXPECT_FALSE(isOverSurface(-0.1, lean, distance, kQuantum)) << "nearer to the light";
            EXPECT_TRUE(isOverSurface(0.1 + lean * distance, lean, distance, kQuantum)) << "one below";
        }
    }
    EXPECT_DOUBLE_EQ(flatterLean(0.2, 0.5, 0.51), 0.51 - 0.5) << "an edge on one side";
    EXPECT_DOUBLE_EQ(flatterLean(0.49, 0.5, 0.9), 0.5 - 0.49);
}

/// The order in which fins win is that of alpha' for the surface below, whatever the light's size.
TEST(SmoothieFins, WinByWhatTheyTakeOfTheLight)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> distances(0.0, 32.0);
    std::uniform_real_distribution<double> falls(1e-4, 1.0);
    for (int i = 0; i < 5000; ++i) {
        const double d[2] = {distances(random), distances(random)};
        const double f[2] = {falls(random), falls(random)};
        const bool first = outweighs(d[0], f[0], d[1], f[1]);
        EXPECT_EQ(finOrder(d[0], f[0]) < finOrder(d[1], f[1]), first);
        for (const double size : {1e-3, 1.0, 300.0}) { // of the light: its cone's width is size * fall
            EXPECT_EQ(d[0] / (size * f[0]) < d[1] / (size * f[1]), first);
        }
        EXPECT_LT(finOrder(d[0], f[0]), 1.0) << "a cleared texel has none";
    }
}

/// Depth is affine along an edge, so half of one from -1 to 1 lies before the near plane.
TEST(SmoothieFins, endAtTheNearPlaneOfMapsThatCut)
{
    EXPECT_EQ(finBeforeNear(-1.0, 1.0), 0.5);
    EXPECT_EQ(finBeforeNear(1.0, -1.0), 0.0) << "the other end is cut";
    EXPECT_EQ(finBeforeNear(-0.25, 0.75), 0.25);
    EXPECT_EQ(finBeforeNear(0.0, 0.0), 0.0) << "clamped";
    EXPECT_EQ(finBeforeNear(-1.0, -2.0), 1.0) << "nothing is left";
    EXPECT_EQ(finBeforeNear(-1.0, 0.0), 1.0);
}

} // namespace
} // namespace gnomon::shared
