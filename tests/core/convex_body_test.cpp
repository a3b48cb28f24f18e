// SPDX-License-Identifier: Apache-2.0
#include "worlds.h"

#include <gtest/gtest.h>

#include <map>

namespace gnomon {
namespace {

using test::Random;

const Aabb kUnit{{0, 0, 0}, {1, 1, 1}};

/// Every edge is walked once in each direction: the surface is closed and all faces turn the same way.
void expectClosed(const ConvexBody& body)
{
    std::map<std::array<double, 6>, int> edges;
    std::size_t first = 0;
    for (const std::uint32_t size : body.faceSizes()) {
        for (std::size_t i = 0; i < size; ++i) {
            const glm::dvec3 a = body.points()[first + i];
            const glm::dvec3 b = body.points()[first + (i + 1) % size];
            ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
        }
        first += size;
    }
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge[3], edge[4], edge[5], edge[0], edge[1], edge[2]});
        EXPECT_TRUE(count == 1 && back != edges.end() && back->second == 1);
    }
}

TEST(ConvexBody, ClosedFormsOfAClippedCube)
{
    const double s = 1.0 / std::sqrt(3.0);
    ConvexBody half = ConvexBody::fromAabb(kUnit);
    half.clip({{1, 0, 0}, -0.25});
    EXPECT_NEAR(half.volume(), 0.75, 1e-15);
    ConvexBody corner = ConvexBody::fromAabb(kUnit);
    corner.clip({{-s, -s, -s}, 0.5 * s}); // x + y + z <= 1/2
    EXPECT_NEAR(corner.volume(), 0.125 / 6.0, 1e-15);
    ConvexBody hexagon = ConvexBody::fromAabb(kUnit);
    hexagon.clip({{s, s, s}, -1.5 * s}); // the cut is a regular hexagon
    EXPECT_NEAR(hexagon.volume(), 0.5, 1e-14);
    expectClosed(hexagon);
    ConvexBody diagonal = ConvexBody::fromAabb(kUnit);
    diagonal.clip({{std::sqrt(0.5), -std::sqrt(0.5), 0}, 0.0}); // through two edges
    EXPECT_NEAR(diagonal.volume(), 0.5, 1e-15);
    expectClosed(diagonal);
}

TEST(ConvexBody, ClipsToNothingOrNotAtAll)
{
    ConvexBody body = ConvexBody::fromAabb(kUnit);
    EXPECT_NEAR(body.clip({{1, 0, 0}, 0.0}).volume(), 1.0, 0.0); // touches a face
    EXPECT_NEAR(body.clip({{1, 0, 0}, 5.0}).volume(), 1.0, 0.0);
    EXPECT_NEAR(body.clip({{0, 0, 0}, 1.0}).volume(), 1.0, 0.0);   // a plane at infinity
    EXPECT_TRUE(ConvexBody(body).clip({{1, 0, 0}, -1.0}).empty()); // only a face is left
    EXPECT_TRUE(ConvexBody(body).clip({{0, 0, 0}, -1.0}).empty());
    EXPECT_TRUE(body.clip({{1, 0, 0}, -2.0}).empty());
    EXPECT_TRUE(body.clip({{1, 0, 0}, 9.0}).empty()); // stays empty
}

TEST(ConvexBody, FromClipRefusesWhatIsNotBounded)
{
    EXPECT_TRUE(ConvexBody::fromClip(glm::dmat4(0.0)).empty());
    EXPECT_TRUE(ConvexBody::fromClip(test::endlessCamera({1, 2, 3}, {0, 0, 0}, 1.0).clip_from_world).empty());
    glm::dmat4 bad(1.0);
    bad[2][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(ConvexBody::fromClip(bad).empty());
}

TEST(ConvexBody, RandomClipsAgreeWithHalfSpacesAndKeepClosed)
{
    Random random(4);
    int survivors = 0;
    for (int round = 0; round < 1500; ++round) {
        const double scale = std::pow(10.0, random.uniform(-2.0, 4.0));
        const glm::dvec3 offset = random.inBox(glm::dvec3(-5), glm::dvec3(5)) * scale;
        const Aabb box = test::boxAt(offset, random.inBox(glm::dvec3(0.1), glm::dvec3(1)) * scale);
        ConvexBody body = ConvexBody::fromAabb(box);
        std::vector<Plane> planes;
        double volume = body.volume();
        for (std::uint32_t i = 0; i < 1 + random.below(10); ++i) {
            Plane plane{random.direction(), 0.0};
            plane.d = -glm::dot(plane.normal, offset + random.direction() * random.uniform(0.0, 0.7) * scale);
            planes.push_back(plane);
            body.clip(plane);
            ASSERT_LE(body.volume(), volume * (1.0 + 1e-12) + 1e-12);
            ASSERT_GE(body.volume(), 0.0);
            volume = body.volume();
        }
        survivors += body.empty() ? 0 : 1;
        expectClosed(body);
        for (const glm::dvec3& p : body.points())
            for (const Plane& plane : planes)
                ASSERT_GE(plane.distance(p), -1e-10 * scale);
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 p = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
            double inside = 1.0;
            for (const Plane& plane : planes)
                inside = std::min(inside, plane.distance(p) / scale);
            if (std::abs(inside) > 1e-9) {
                ASSERT_EQ(body.contains(p, 1e-10 * scale), inside > 0.0);
            }
        }
    }
    EXPECT_GT(survivors, 400);
}

TEST(ConvexBody, HullOfCornersIsTheBody)
{
    Random random(6);
    for (int round = 0; round < 300; ++round) {
        ConvexBody body = ConvexBody::fromAabb(kUnit);
        for (int i = 0; i < 4; ++i)
            body.clip({random.direction(), random.uniform(0.0, 1.0)});
        if (body.volume() < 1e-6)
            continue;
        std::vector<glm::dvec3> points(body.points().begin(), body.points().end());
        for (int i = 0; i < 20; ++i) { // points inside change nothing
            const glm::dvec3 a = points[random.below(static_cast<std::uint32_t>(body.points().size()))];
            points.push_back(glm::mix(a, points[0], random.uniform()));
        }
        const ConvexBody hull = ConvexBody::hull(points);
        EXPECT_NEAR(hull.volume(), body.volume(), 1e-9);
        for (const glm::dvec3& p : points)
            EXPECT_TRUE(hull.contains(p, 1e-9));
    }
}

TEST(ConvexBody, FlatOrFewPointsHaveNoHull)
{
    const std::vector<glm::dvec3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 1e-12}};
    EXPECT_TRUE(ConvexBody::hull(flat).empty());
    EXPECT_TRUE(ConvexBody::hull(std::span(flat).first(3)).empty());
    EXPECT_TRUE(ConvexBody::hull({}).empty());
    EXPECT_TRUE(ConvexBody::hull(std::vector<glm::dvec3>(7, glm::dvec3(1, 2, 3))).empty());
}

TEST(ConvexBody, SweptVolumeIsTheBodyAndItsShadowTimesTheLength)
{
    const ConvexBody cube = ConvexBody::fromAabb(kUnit);
    EXPECT_NEAR(cube.swept({0, 5, 0}).volume(), 6.0, 1e-9);
    // A cube's shadow along its diagonal is a hexagon of area sqrt(3).
    const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1, 1, 1)) * 2.0;
    EXPECT_NEAR(cube.swept(diagonal).volume(), 1.0 + 2.0 * std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(cube.swept(glm::dvec3(0.0)).volume(), 1.0, 1e-9);
}

} // namespace
} // namespace gnomon
