// SPDX-License-Identifier: Apache-2.0
// The map of a half space: places there and back, its rows against finite differences, and what a caster leaves in it.
#define GNOMON_REAL double
#include <gnomon/lib/caster.glsl>
#include <gnomon/shared/paraboloid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::shared {
namespace {

struct Random {
    std::mt19937 rng{7};
    std::uniform_real_distribution<double> u{-1.0, 1.0};

    double operator()() { return u(rng); }
    glm::dvec3 point() { return {u(rng), u(rng), u(rng)}; }
    glm::dvec3 unit() { return glm::normalize(point() + glm::dvec3(1e-3)); }
    /// In front of the light.
    glm::dvec3 before()
    {
        glm::dvec3 q = point();
        q.z = std::abs(q.z);
        return q;
    }
};

/// A map of 256 texels at tile (32, 64) whose disc leaves 4 to the border: eye-relative rows, the light anywhere.
struct Map {
    MapRows rows{};
    glm::dvec4 places{124.0, 124.0, 160.0, 192.0};
    double near = -0.01;

    explicit Map(Random& random)
    {
        const glm::dvec3 z = random.unit();
        const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.3, 0.5, -0.7)));
        const glm::dvec3 y = glm::cross(z, x);
        const glm::dvec3 light = random.point() * 3.0;
        const double length = 5.0; // far - near
        rows.x = glm::dvec4(x, -glm::dot(x, light)) / length;
        rows.y = glm::dvec4(y, -glm::dot(y, light)) / length;
        rows.w = glm::dvec4(z, -glm::dot(z, light)) / length;
        rows.metric = glm::dvec4(0.0, 0.0, 0.0, near);
        rows.range_m = length;
    }
    [[nodiscard]] glm::dvec3 q(const glm::dvec3& p) const
    {
        return {dotRow(rows.x, p), dotRow(rows.y, p), dotRow(rows.w, p)};
    }
    [[nodiscard]] glm::dvec2 texel(const glm::dvec3& p) const
    {
        return paraboloidPlace(q(p)) * glm::dvec2(places) + glm::dvec2(places.z, places.w);
    }
    [[nodiscard]] double depth(const glm::dvec3& p) const { return glm::length(q(p)) + near; }
};

TEST(Paraboloid, PlacesAndDirectionsAreInverse)
{
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 d = random.unit();
        if (d.z < -0.99)
            continue;
        const glm::dvec2 place = paraboloidPlace(d * std::exp2(20.0 * random()));
        EXPECT_NEAR(glm::distance(paraboloidDirection(place), d), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(place), std::tan(0.5 * std::acos(d.z)), 1e-9);
        EXPECT_EQ(glm::length(place) <= 1.0, d.z >= 0.0);
    }
    EXPECT_EQ(paraboloidPlace({0, 0, 3}), glm::dvec2(0.0));
    EXPECT_EQ(paraboloidPlace({0, 0, 0}), glm::dvec2(0.0));
    EXPECT_TRUE(std::isfinite(paraboloidPlace({1e-9, 0, -3}).x));
    EXPECT_LT(glm::length(paraboloidPlace({0.06, 0.0, -1.0})), 40.0) << "places behind stay finite";
}

TEST(Paraboloid, RowsAreTheMapAtTheirPointAndBesideIt)
{
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const Map map(random);
        const glm::dvec3 p = random.point() * 4.0;
        if (glm::length(map.q(p)) < 0.02 || map.q(p).z < 0.0)
            continue;
        const MapRows rows = paraboloidRows(map.rows, map.places, p);
        const auto texelBy = [&](const glm::dvec3& at) {
            return texelAt(rows, at, mapW(rows, at));
        };
        EXPECT_NEAR(glm::distance(texelBy(p), map.texel(p)), 0.0, 1e-9);
        EXPECT_NEAR(dotRow(rows.metric, p), map.depth(p), 1e-12);
        const double h = 1e-6;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = h;
            const glm::dvec2 moved = (map.texel(p + step) - map.texel(p - step)) / (2.0 * h);
            EXPECT_NEAR(glm::distance(moved, (texelBy(p + step) - texelBy(p - step)) / (2.0 * h)), 0.0,
                        1e-6 * (1.0 + glm::length(moved)));
            EXPECT_NEAR((map.depth(p + step) - map.depth(p - step)) / (2.0 * h), rows.metric[axis], 1e-6);
        }
        EXPECT_EQ(rows.range_m, map.rows.range_m);
    }
}

/// No tap is compared with more than the receiver's own plane left in the map, or the plane would shade itself.
TEST(Paraboloid, APlaneIsNotBeforeWhatItsReceiversCompareWith)
{
    Random random;
    int tried = 0;
    int beyond = 0;
    for (int i = 0; i < 5000; ++i) {
        const Map map(random);
        const glm::dvec3 p = random.point() * 4.0;
        const glm::dvec3 q = map.q(p);
        const glm::dvec3 axes[] = {glm::dvec3(map.rows.x) * map.rows.range_m, glm::dvec3(map.rows.y) * map.rows.range_m,
                                   glm::dvec3(map.rows.w) * map.rows.range_m};
        const glm::dvec3 toward = -(axes[0] * q.x + axes[1] * q.y + axes[2] * q.z) / glm::length(q);
        glm::dvec3 n = random.unit();
        n *= glm::dot(n, toward) < 0.0 ? -1.0 : 1.0;
        if (q.z < 0.0 || glm::length(q) < 0.02 || glm::dot(n, toward) < 0.1)
            continue;
        BiasRule rule{};
        rule.automatic = 1.0;
        rule.reach_texels = 2.0;
        const glm::dvec3 n_q(glm::dot(n, axes[0]), glm::dot(n, axes[1]), glm::dot(n, axes[2]));
        const MapPoint point = projectReceiver(paraboloidRows(map.rows, map.places, p), rule, p, n);
        MapPoint unbiased = point;
        unbiased.depth = map.depth(p);
        unbiased.cap = 1e9;
        for (const glm::dvec2 d : {glm::dvec2(2, 0), glm::dvec2(-2, 1), glm::dvec2(0.5, -2)}) {
            const glm::dvec2 place = (point.texel + d - glm::dvec2(map.places.z, map.places.w)) / map.places.x;
            const double plane = glm::dot(n_q, q) / glm::dot(n_q, paraboloidDirection(place)) + map.near;
            if (!(plane > 0.0))
                continue;
            const glm::dvec2 reference = referenceAt(point, d);
            EXPECT_LE(reference.x, plane * reference.y);
            const glm::dvec2 exact = referenceAt(unbiased, d);
            beyond += exact.x > plane * exact.y ? 1 : 0;
            ++tried;
        }
    }
    EXPECT_GT(tried, 1000);
    EXPECT_GT(beyond, 100) << "without a bias this says nothing";
}

TEST(Paraboloid, AFragmentHasTheDepthOfItsOwnRayOnItsPlane)
{
    Random random;
    int met = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 corners[] = {random.before(), random.before(), random.before()};
        const double near = -0.05;
        glm::dvec3 rims[3];
        for (int c = 0; c < 3; ++c)
            rims[c] = casterRim(glm::dvec4(corners[c], 1.05));
        const double s = 0.5 * (1.0 + random()) * 0.9;
        const double t = (1.0 - s) * 0.5 * (1.0 + random());
        const glm::dvec3 share(s, t, 1.0 - s - t);
        const glm::dvec3 q = corners[0] * share.x + corners[1] * share.y + corners[2] * share.z;
        const glm::dvec3 rim = rims[0] * share.x + rims[1] * share.y + rims[2] * share.z;
        const glm::dvec3 right = (corners[1] - corners[0]) * 0.01 + (corners[2] - corners[0]) * 0.003;
        const glm::dvec3 below = (corners[2] - corners[0]) * 0.02 - (corners[1] - corners[0]) * 0.001;
        const double metric = casterRadial(rim, q, right, below, near);
        if (metric < near) // the triangle's plane is not before the light there
            continue;
        ++met;
        const glm::dvec3 at = paraboloidDirection(glm::dvec2(rim)) * (metric - near);
        const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        EXPECT_NEAR(glm::dot(normal, at - corners[0]), 0.0, 1e-8 * (1.0 + glm::length(at)));
    }
    EXPECT_GT(met, 500);
}

TEST(Paraboloid, WhatIsBehindTheLightIsDiscarded)
{
    // A floor all of whose corners are just behind: straight edges from one to the other would cover the whole disc.
    const glm::dvec3 corners[] = {{3.0, 0.0, -0.02}, {-2.0, 3.0, -0.02}, {-2.0, -3.0, -0.02}};
    glm::dvec3 rim(0.0);
    glm::dvec3 q(0.0);
    for (const glm::dvec3& corner : corners) {
        rim += casterRim(glm::dvec4(corner, 1.1)) / 3.0;
        q += corner / 3.0;
    }
    EXPECT_GT(rim.z, 0.0) << "within the border";
    EXPECT_LT(casterRadial(rim, q, {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}, -0.001), 0.0);
    // And in front: the axis meets it at 0.02, and this ray a little farther off.
    q.z = 0.02;
    const double along = 0.02 / paraboloidDirection(glm::dvec2(rim)).z;
    EXPECT_NEAR(casterRadial(rim, q, {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}, -0.001), along - 0.001, 1e-12);
    // Farther behind than the border shows, or nearer than the near distance.
    EXPECT_LT(casterRim({1.0, 0.0, -1.0, 1.05}).z, 0.0);
    EXPECT_LT(casterParaboloid({1.0, 0.0, -1.0, 1.05}).z, 0.0) << "the near plane cuts it";
    EXPECT_LT(casterRadial(rim, q, {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}, -0.03), 0.0);
    // The border itself is kept: twice as much is.
    const glm::dvec3 edge = paraboloidDirection({1.05, 0.0});
    EXPECT_GT(casterRim(glm::dvec4(edge, 1.05)).z, 0.0);
}

TEST(Paraboloid, AVertexIsAtItsPlaceInTheBorderedMap)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 q = random.before();
        const glm::dvec4 position = casterParaboloid(glm::dvec4(q, 1.25));
        EXPECT_NEAR(glm::distance(glm::dvec2(position), paraboloidPlace(q) / 1.25), 0.0, 1e-15);
        EXPECT_EQ(position.w, 1.0);
        EXPECT_TRUE(position.z > 0.0 && position.z <= 1.0);
        EXPECT_LT(casterParaboloid(glm::dvec4(-q, 1.25)).z, position.z);
        EXPECT_LE(std::max(std::abs(position.x), std::abs(position.y)), 0.8);
    }
}

/// How far the middle of a straight edge is drawn from where it is, of all edges that span an angle: the sagitta of
/// docs/techniques/paraboloid.md. On a great circle through the rim's two ends, at right angles to the axis, it is all.
TEST(Paraboloid, AStraightEdgeIsOffByTheSagittaOfItsArc)
{
    Random random;
    for (const double angle : {0.05, 0.2, 0.5, 1.0}) {
        double worst = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 middle = random.unit();
            const glm::dvec3 aside = glm::normalize(glm::cross(middle, random.unit()));
            const glm::dvec3 a = middle * std::cos(0.5 * angle) + aside * std::sin(0.5 * angle);
            const glm::dvec3 b = middle * std::cos(0.5 * angle) - aside * std::sin(0.5 * angle);
            if (a.z < 0.0 || b.z < 0.0)
                continue;
            const glm::dvec2 pa = paraboloidPlace(a);
            const glm::dvec2 pb = paraboloidPlace(b);
            const glm::dvec2 chord = glm::normalize(pb - pa);
            for (int step = 1; step < 10; ++step) {
                const double t = angle * (0.1 * step - 0.5);
                const glm::dvec2 arc = paraboloidPlace(middle * std::cos(t) - aside * std::sin(t)) - pa;
                worst = std::max(worst, std::abs(arc.x * chord.y - arc.y * chord.x));
            }
        }
        const double rim = 1.0 - std::cos(0.5 * angle); // along the rim, which is the unit circle
        EXPECT_LE(worst, 1.0001 * rim) << angle;
        EXPECT_GT(worst, 0.9 * rim) << angle;
    }
}

} // namespace
} // namespace gnomon::shared
