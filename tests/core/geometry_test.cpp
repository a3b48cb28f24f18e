// SPDX-License-Identifier: Apache-2.0
#include "worlds.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

using test::Random;

TEST(Aabb, EmptyIsTheIdentityOfMerge)
{
    const Aabb empty;
    const Aabb box{{-1, 2, 3}, {4, 5, 6}};
    EXPECT_TRUE(empty.empty());
    EXPECT_TRUE(merge(empty, empty).empty());
    for (const Aabb& merged : {merge(empty, box), merge(box, empty)}) {
        EXPECT_EQ(merged.min, box.min);
        EXPECT_EQ(merged.max, box.max);
    }
    EXPECT_EQ(merge(box, glm::vec3(10, 0, 4)).max, glm::vec3(10, 5, 6));
    EXPECT_EQ(merge(box, glm::vec3(10, 0, 4)).min, glm::vec3(-1, 0, 3));
    EXPECT_EQ(merge(empty, glm::vec3(1, 2, 3)).max, glm::vec3(1, 2, 3));
}

TEST(Aabb, TransformIsTightAroundTheTransformedCorners)
{
    Random random(1);
    for (int round = 0; round < 500; ++round) {
        const glm::dvec3 low = random.inBox(glm::dvec3(-9), glm::dvec3(9));
        const Aabb box{glm::vec3(low), glm::vec3(low + random.inBox(glm::dvec3(0), glm::dvec3(5)))};
        glm::dmat4 m = glm::rotate(glm::dmat4(1.0), random.uniform(0.0, 6.0), random.direction());
        m = glm::scale(m, random.inBox(glm::dvec3(-2), glm::dvec3(2)));
        m[3] = glm::dvec4(random.inBox(glm::dvec3(-9), glm::dvec3(9)), 1.0);
        Aabb expected;
        for (int i = 0; i < 8; ++i)
            expected = merge(expected, glm::vec3(m * glm::dvec4(box.corner(i), 1.0)));
        const Aabb found = transform(glm::mat4(m), box);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(found.min[axis], expected.min[axis], 2e-5);
            EXPECT_NEAR(found.max[axis], expected.max[axis], 2e-5);
        }
    }
    EXPECT_TRUE(transform(glm::mat4(1.0F), Aabb{}).empty());
}

TEST(Frustum, PlanesAgreeWithTheMatrix)
{
    Random random(2);
    for (int round = 0; round < 200; ++round) {
        const glm::dvec3 eye = random.inBox(glm::dvec3(-50), glm::dvec3(50));
        const Camera camera = round % 2 == 0
                                  ? test::perspectiveCamera(eye, eye + random.direction(), random.uniform(0.1, 2.9))
                                  : test::orthographicCamera(eye, eye + random.direction(), 20.0);
        const Frustum frustum = frustumFromClip(camera.clip_from_world);
        for (const Plane& plane : frustum.planes)
            EXPECT_NEAR(glm::length(plane.normal), 1.0, 1e-12);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 p = eye + random.inBox(glm::dvec3(-60), glm::dvec3(60));
            const glm::dvec4 c = camera.clip_from_world * glm::dvec4(p, 1.0);
            const bool inside = c.x >= -c.w && c.x <= c.w && c.y >= -c.w && c.y <= c.w && c.z >= 0.0 && c.z <= c.w;
            bool found = true;
            for (const Plane& plane : frustum.planes)
                found &= plane.distance(p) >= 0.0;
            EXPECT_EQ(found, inside);
        }
    }
}

TEST(Frustum, OrderAndDistancesOfAKnownOne)
{
    // 90 degrees, looking along -z, near 1, far 10, z not reversed.
    const Frustum frustum = frustumFromClip(glm::perspectiveRH_ZO(glm::half_pi<double>(), 1.0, 1.0, 10.0));
    const double s = std::sqrt(0.5);
    const glm::dvec3 normals[] = {{s, 0, -s}, {-s, 0, -s}, {0, s, -s}, {0, -s, -s}, {0, 0, -1}, {0, 0, 1}};
    const double offsets[] = {0, 0, 0, 0, -1, 10};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(glm::distance(frustum.planes[i].normal, normals[i]), 0.0, 1e-12) << i;
        EXPECT_NEAR(frustum.planes[i].d, offsets[i], 1e-9) << i;
    }
}

TEST(Frustum, PlaneAtInfinityKeepsEverything)
{
    const Camera camera = test::endlessCamera({3, 4, 5}, {0, 0, 0}, 1.0);
    const Frustum frustum = frustumFromClip(camera.clip_from_world);
    EXPECT_EQ(frustum.planes[4].normal, glm::dvec3(0.0)); // z >= 0: far, because z is reversed
    EXPECT_EQ(frustum.planes[4].d, 1.0);
    EXPECT_NEAR(frustum.planes[5].distance({3, 4, 5}), -0.1, 1e-9);
}

TEST(Classify, IsConservativeAndRightInTheClearCases)
{
    const Frustum frustum =
        frustumFromClip(test::perspectiveCamera({0, 0, 0}, {0, 0, -1}, 1.0, 1.0, 1.0, 100.0).clip_from_world);
    EXPECT_EQ(classify(frustum.planes, test::boxAt({0, 0, -50}, glm::dvec3(1))), Containment::inside);
    EXPECT_EQ(classify(frustum.planes, test::boxAt({0, 0, -100}, glm::dvec3(1))), Containment::intersects);
    EXPECT_EQ(classify(frustum.planes, test::boxAt({0, 0, 50}, glm::dvec3(1))), Containment::outside);
    Random random(3);
    for (int round = 0; round < 2000; ++round) {
        const Aabb box = test::boxAt(random.inBox(glm::dvec3(-60, -60, -110), glm::dvec3(60, 60, 10)),
                                     random.inBox(glm::dvec3(0), glm::dvec3(20)));
        const Containment found = classify(frustum.planes, box);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 p = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
            bool inside = true;
            for (const Plane& plane : frustum.planes)
                inside &= plane.distance(p) >= 0.0;
            if (found == Containment::outside) {
                EXPECT_FALSE(inside);
            }
            if (found == Containment::inside) {
                EXPECT_TRUE(inside);
            }
        }
    }
}

TEST(PlanesAround, HoldWhatIsInTheBox)
{
    const glm::dvec3 low(-1.0, 2.0, -7.0);
    const glm::dvec3 high(3.0, 2.5, 11.0);
    const auto inside = [planes = planesAround(low, high)](const glm::dvec3& p) {
        return std::ranges::all_of(planes, [&](const Plane& plane) { return plane.distance(p) >= 0.0; });
    };
    EXPECT_TRUE(inside(low));
    EXPECT_TRUE(inside(high));
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 below = low;
        glm::dvec3 above = high;
        below[axis] -= 1e-9;
        above[axis] += 1e-9;
        EXPECT_FALSE(inside(below)) << axis;
        EXPECT_FALSE(inside(above)) << axis;
    }
}

} // namespace
} // namespace gnomon
