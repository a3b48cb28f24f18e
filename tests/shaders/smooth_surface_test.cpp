// SPDX-License-Identifier: Apache-2.0
// The smooth surface over triangles against a ball, of which it is known in closed form, and which point takes its
// light from there.
#include "cpu_map.h"

#include <gnomon/lib/visibility.glsl>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace gnomon::shared {
namespace {

using glm::dvec3;

/// A triangle with a normal at each corner, and a point of it.
struct Sample {
    dvec3 p;
    dvec3 n; // of the triangle
    dvec3 normal{0.0};
    double plane = 0.0; // of the corners' planes, relative to `eye`
};

class Triangles {
public:
    /// On a ball of radius `radius` around `centre`, about `side` of the radius wide. `outward`: -1 for its inside.
    Sample on(double radius, const dvec3& centre, double side, double outward = 1.0)
    {
        const dvec3 middle = direction();
        std::array<dvec3, 3> normals;
        for (dvec3& normal : normals) {
            normal = glm::normalize(middle + side * direction());
        }
        const std::array<double, 3> raw{share(), share(), share()};
        const double sum = raw[0] + raw[1] + raw[2];
        Sample sample{};
        sample.p = centre;
        for (int k = 0; k < 3; ++k) {
            sample.p += normals[k] * (radius * raw[k] / sum);
        }
        sample.n = glm::normalize(glm::cross(normals[1] - normals[0], normals[2] - normals[0]));
        sample.n *= (glm::dot(sample.n, normals[0]) < 0.0 ? -1.0 : 1.0) * outward;
        for (int k = 0; k < 3; ++k) {
            const dvec3 vertex = centre + normals[k] * radius;
            sample.normal += normals[k] * (outward * raw[k] / sum);
            sample.plane += glm::dot(normals[k] * outward, vertex) * raw[k] / sum;
        }
        return sample;
    }
    dvec3 direction() { return glm::normalize(dvec3(normal_(random_), normal_(random_), normal_(random_))); }

private:
    double share() { return 0.01 + std::abs(normal_(random_)); }

    std::mt19937 random_{7};
    std::normal_distribution<double> normal_;
};

bool isFlat(const SmoothSurface& s, const dvec3& n)
{
    return s.n == n && s.lift < 0.0;
}

TEST(SmoothSurface, OfABallIsTheInversePoint)
{
    Triangles triangles;
    int over = 0;
    for (int i = 0; i < 2000; ++i) {
        const dvec3 centre = 3.0 * triangles.direction();
        const Sample at = triangles.on(0.5, centre, 0.3);
        const SmoothSurface s = smoothSurface(at.p, at.n, at.normal, at.plane);
        if (s.lift < 0.0) {
            continue;
        }
        ++over;
        const dvec3 out = at.p - centre;
        const dvec3 inverse = centre + out * (0.25 / glm::dot(out, out));
        EXPECT_LT(glm::length(s.n - glm::normalize(out)), 1e-12);
        EXPECT_LT(glm::length(at.p + s.n * s.lift - inverse), 1e-12);
        // Seen from behind it is a hollow.
        EXPECT_TRUE(isFlat(smoothSurface(at.p, -at.n, at.normal, at.plane), -at.n));
    }
    EXPECT_GT(over, 1900);
}

TEST(SmoothSurface, IsNotOverAHollowACardOrWhatIsNearlyFlat)
{
    Triangles triangles;
    for (int i = 0; i < 500; ++i) {
        const Sample at = triangles.on(2.0, 5.0 * triangles.direction(), 0.3, -1.0);
        EXPECT_TRUE(isFlat(smoothSurface(at.p, at.n, at.normal, at.plane), at.n));
        // One normal at all corners; a ball so large that it is flat.
        const dvec3 normal = triangles.direction();
        EXPECT_TRUE(isFlat(smoothSurface(at.p, at.n, normal, glm::dot(normal, at.p)), at.n));
        const Sample large = triangles.on(500.0, 500.0 * triangles.direction(), 1e-5);
        EXPECT_TRUE(isFlat(smoothSurface(large.p, large.n, large.normal, large.plane), large.n));
    }
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const double length : {0.0, kNan}) {
        const dvec3 up(0.0, 1.0, 0.0);
        EXPECT_TRUE(isFlat(smoothSurface({1.0, 2.0, 3.0}, up, up * length, 0.0), up));
    }
}

TEST(SmoothSurface, IsNotOverATriangleWithACreasedCorner)
{
    Triangles triangles;
    for (int i = 0; i < 500; ++i) {
        const Sample at = triangles.on(1.0, 4.0 * triangles.direction(), 0.4);
        const dvec3 normal = triangles.direction();
        EXPECT_EQ(smoothPlane(normal, at.p, false), glm::dot(normal, at.p));
        // A corner that has no more than a thousandth of the triangle.
        const double more = smoothPlane(normal, at.p, true) - smoothPlane(normal, at.p, false);
        for (const double share : {0.001, 0.5, 1.0}) {
            EXPECT_TRUE(isFlat(smoothSurface(at.p, at.n, at.normal, at.plane + share * more), at.n));
            EXPECT_TRUE(isFlat(smoothSurface(at.p, at.n, -at.normal, -at.plane + share * more), at.n));
        }
    }
}

// The stored value does not change when everything is twice as large.
TEST(SmoothSurface, IsStoredAsSharesOfTheDistance)
{
    Triangles triangles;
    for (int i = 0; i < 500; ++i) {
        Sample at = triangles.on(1.0, 4.0 * triangles.direction(), 0.4);
        const SmoothSurface s = smoothSurface(at.p, at.n, at.normal, at.plane);
        const dvec3 stored = smoothEncode(s, at.p);
        const SmoothSurface read = smoothDecode(stored, at.p, at.n);
        if (s.lift < 0.0) {
            EXPECT_TRUE(isFlat(read, at.n));
            continue;
        }
        EXPECT_LT(glm::length(read.n - s.n), 1e-12);
        EXPECT_NEAR(read.lift, s.lift, 1e-12);
        const double times = std::ldexp(1.0, i % 40 - 20);
        const SmoothSurface larger = smoothSurface(at.p * times, at.n, at.normal, at.plane * times);
        EXPECT_EQ(smoothEncode(larger, at.p * times), stored);
    }
    SmoothSurface far;
    far.n = {0.0, 1.0, 0.0};
    far.lift = 1e9;
    EXPECT_EQ(smoothEncode(far, {0.0, 0.0, 1.0}).z, 1.0);
}

// By the normal's direction, which who shades has already, the lift is the same.
TEST(SmoothSurface, IsStoredLikewiseByItsUnitNormal)
{
    Triangles triangles;
    int flat = 0;
    for (int i = 0; i < 600; ++i) {
        const Sample at =
            triangles.on(1.0, 4.0 * triangles.direction(), i % 3 == 0 ? 0.0005 : 0.4, i % 2 == 0 ? 1 : -1);
        for (const dvec3& n : {at.n, -at.n}) {
            const double stored = smoothEncode(smoothSurface(at.p, n, at.normal, at.plane), at.p).z;
            const dvec3 unit = glm::normalize(at.normal) * (glm::dot(at.normal, n) < 0.0 ? -1.0 : 1.0);
            EXPECT_NEAR(smoothLift(at.p, n, unit, at.normal, at.plane), stored, 1e-9);
            flat += stored == 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(flat, 700); // half of all are hollows, and of the rest a third is nearly flat
    EXPECT_LT(flat, 900);
    const dvec3 none(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(smoothLift({1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, none, {0.0, 0.0, 0.0}, 0.0), 0.0);
}

// The area of a disc's part over a line, beside the curve that stands for it, and a light without a size.
TEST(ShareOverHorizon, IsTheDiscs)
{
    const dvec3 n(0.0, 1.0, 0.0);
    for (const double length : {0.01, 1.0, 300.0}) {
        for (const double radius : {0.002, 0.005, 0.03, 0.2}) {
            for (double height = -2.0; height <= 2.0; height += 0.01) {
                const dvec3 to_light = length * glm::normalize(dvec3(1.0, height * radius, 0.0));
                const double t = std::clamp(glm::dot(n, to_light) / (radius * length), -1.0, 1.0);
                const double area = 0.5 + (std::asin(t) + t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
                EXPECT_NEAR(shareOverHorizon(n, to_light, radius * length), area, 0.04) << height << ' ' << radius;
            }
        }
        for (const double height : {-0.5, 0.0, 0.001, 0.0019, 0.0021, 0.004, 0.5}) {
            const dvec3 to_light = length * glm::normalize(dvec3(1.0, height, 0.0));
            EXPECT_EQ(shareOverHorizon(n, to_light, 0.0), height > kGrazing ? 1.0 : 0.0) << height;
        }
    }
}

TEST(ShareOverHorizon, IsANumberAtALightsOwnPlace)
{
    EXPECT_EQ(shareOverHorizon(dvec3(0.0, 1.0, 0.0), dvec3(0.0), 0.0), 0.0);
}

// Bit for bit, so that nothing changes for flat meshes, nor for hosts that have no normals.
TEST(LightPoint, OfAFlatSurfaceIsItself)
{
    Triangles triangles;
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p = triangles.direction();
        const dvec3 n = triangles.direction();
        const dvec3 to_light = 3.0 * glm::normalize(triangles.direction() - n * (i % 2 == 0 ? 0.0 : glm::dot(n, p)));
        const LightPoint flat = lightPoint(p, n, flatSurface(n), to_light, 0.01);
        EXPECT_EQ(flat.p, p);
        EXPECT_EQ(flat.n, n);
        EXPECT_EQ(flat.share, shareOverHorizon(n, to_light, 0.01));
    }
}

TEST(LightPoint, IsLiftedWhereOnlyTheTriangleFacesAway)
{
    Triangles triangles;
    int lifted = 0;
    int dark = 0;
    for (int i = 0; i < 4000; ++i) {
        const dvec3 centre = 4.0 * triangles.direction();
        const Sample at = triangles.on(1.0, centre, 0.4);
        const SmoothSurface s = smoothSurface(at.p, at.n, at.normal, at.plane);
        if (s.lift < 0.0) {
            continue;
        }
        const dvec3 to_light = triangles.direction();
        const LightPoint light = lightPoint(at.p, at.n, s, to_light, 0.0);
        const bool triangle_faces = shareOverHorizon(at.n, to_light, 0.0) > 0.5;
        EXPECT_EQ(light.share, shareOverHorizon(s.n, to_light, 0.0));
        dark += triangle_faces && light.share < 0.5 ? 1 : 0;
        if (glm::dot(at.n, glm::normalize(to_light)) >= kHardlyFaces) {
            EXPECT_EQ(light.p, at.p);
            EXPECT_EQ(light.n, at.n);
        } else if (light.share > 0.5) {
            ++lifted;
            // No ray from there meets the ball.
            const dvec3 out = light.p - centre;
            EXPECT_GE(glm::length(out), 1.0 - 1e-12);
            EXPECT_GT(glm::dot(out, to_light), 0.0);
            // Filters follow the plane from here on.
            EXPECT_GT(glm::dot(light.n, to_light), 0.0499);
            EXPECT_GT(glm::dot(light.n, s.n), 0.998);
        }
    }
    EXPECT_GT(lifted, 100);
    EXPECT_GT(dark, 100);
}

} // namespace
} // namespace gnomon::shared
