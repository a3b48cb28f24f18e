// SPDX-License-Identifier: Apache-2.0
#include "worlds.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using test::Random;

Aabb randomBox(Random& random)
{
    const double size = std::pow(10.0, random.uniform(-3.0, 2.0));
    const glm::dvec3 centre = random.inBox(glm::dvec3(-300), glm::dvec3(300));
    return test::boxAt(centre, random.inBox(glm::dvec3(0), glm::dvec3(size)));
}

std::vector<Plane> randomRegion(Random& random)
{
    std::vector<Plane> planes;
    const glm::dvec3 centre = random.inBox(glm::dvec3(-300), glm::dvec3(300));
    for (std::uint32_t i = 0; i < random.below(10); ++i) {
        const glm::dvec3 normal = random.direction();
        planes.push_back({normal, -glm::dot(normal, centre) + random.uniform(0.0, 150.0)});
    }
    return planes;
}

std::vector<std::uint32_t> bruteForce(const ObjectSet& set, std::span<const Plane> planes, ObjectSet::Want want)
{
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < set.size(); ++i) {
        if (!set.alive(i))
            continue;
        const ObjectFlags flags = set.flags(i);
        const bool wanted =
            want == ObjectSet::Want::all || (want == ObjectSet::Want::casters ? flags.casts : flags.receives);
        if (wanted && classify(planes, set.bounds(i)) != Containment::outside)
            found.push_back(i);
    }
    return found;
}

TEST(ObjectSet, QueryEqualsBruteForceOverRandomMoves)
{
    Random random(10);
    ObjectSet set;
    std::size_t total = 0;
    for (int round = 0; round < 400; ++round) {
        for (int i = 0; i < 40; ++i) {
            const std::uint32_t action = random.below(10);
            const std::uint32_t object = set.size() == 0 ? 0 : random.below(set.size());
            if (action < 3 || set.size() == 0) {
                set.add(randomBox(random), {random.below(4) != 0, random.below(4) != 0, random.below(2) != 0});
            } else if (action < 5 && set.alive(object)) {
                set.remove(set.idAt(object));
            } else if (action < 8 && set.alive(object)) { // a short step, which mostly stays in its cell
                const glm::vec3 step(random.inBox(glm::dvec3(-2), glm::dvec3(2)));
                set.update(set.idAt(object), {set.bounds(object).min + step, set.bounds(object).max + step});
            } else if (set.alive(object)) {
                set.update(set.idAt(object), randomBox(random));
            }
        }
        for (const auto want : {ObjectSet::Want::casters, ObjectSet::Want::receivers, ObjectSet::Want::all}) {
            const std::vector<Plane> planes = randomRegion(random);
            std::vector<std::uint32_t> found;
            set.query(planes, want, found);
            ASSERT_EQ(found, bruteForce(set, planes, want)) << "round " << round;
            total += found.size();
        }
    }
    EXPECT_GT(total, 10000U);
}

TEST(ObjectSet, CellsHoldEveryObjectOnce)
{
    Random random(11);
    ObjectSet set;
    EXPECT_TRUE(set.cells().empty());
    for (int i = 0; i < 300; ++i) {
        set.add(randomBox(random), {.dynamic = random.below(2) != 0});
    }
    for (std::uint32_t i = 0; i < 300; i += 3) {
        set.remove(set.idAt(i));
    }
    std::uint32_t held = 0;
    for (const OctreeCell& cell : set.cells()) {
        EXPECT_GE(cell.objects, 1U);
        EXPECT_NEAR(cell.bounds_ws.extent().x, cell.bounds_ws.extent().z, 1e-3F * cell.bounds_ws.extent().x);
        held += cell.objects;
    }
    EXPECT_EQ(held, 200U);
    for (std::uint32_t i = 1; i < 300; i += 3) {
        const std::vector<OctreeCell> cells = set.cells();
        EXPECT_TRUE(std::any_of(cells.begin(), cells.end(), [&](const OctreeCell& cell) {
            const glm::vec3 loose = cell.bounds_ws.extent() * 0.5F;
            return Aabb{cell.bounds_ws.min - loose, cell.bounds_ws.max + loose}.contains(set.bounds(i));
        })) << i;
    }
}

TEST(ObjectSet, QueryAppendsAndTakesManyPlanes)
{
    ObjectSet set;
    set.add({{0, 0, 0}, {1, 1, 1}});
    set.add({{100, 0, 0}, {101, 1, 1}});
    std::vector<std::uint32_t> out{7};
    std::vector<Plane> planes(50, Plane{{0, 1, 0}, 10.0});
    planes.front() = {{-1, 0, 0}, 50.0};
    set.query(planes, ObjectSet::Want::all, out);
    EXPECT_EQ(out, (std::vector<std::uint32_t>{7, 0}));
}

TEST(ObjectSet, ManyInOnePlaceDoNotDivideForEver)
{
    ObjectSet set;
    for (int i = 0; i < 500; ++i)
        set.add({{1, 2, 3}, {1, 2, 3}});
    set.add({{1, 2, 3}, {1e6F, 2, 3}});
    std::vector<std::uint32_t> out;
    set.query({}, ObjectSet::Want::all, out);
    EXPECT_EQ(out.size(), 501U);
    for (std::uint32_t i = 0; i <= 500; ++i)
        set.remove(set.idAt(i));
    EXPECT_EQ(set.size(), 0U);
    out.clear();
    set.query({}, ObjectSet::Want::all, out);
    EXPECT_TRUE(out.empty());
}

TEST(ObjectSet, BoundsAreExactAfterEveryChange)
{
    Random random(11);
    ObjectSet set;
    EXPECT_TRUE(set.bounds().empty());
    for (int round = 0; round < 2000; ++round) {
        const std::uint32_t object = set.size() == 0 ? 0 : random.below(set.size());
        if (random.below(3) == 0 || set.size() == 0)
            set.add(randomBox(random));
        else if (set.alive(object) && random.below(2) == 0)
            set.remove(set.idAt(object));
        else if (set.alive(object))
            set.update(set.idAt(object), randomBox(random));
        Aabb expected;
        for (std::uint32_t i = 0; i < set.size(); ++i)
            if (set.alive(i))
                expected = merge(expected, set.bounds(i));
        ASSERT_EQ(set.bounds().min, expected.min);
        ASSERT_EQ(set.bounds().max, expected.max);
    }
}

TEST(ObjectSet, IndicesAreDenseAndTheSmallestIsReused)
{
    ObjectSet set;
    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    for (std::uint32_t i = 0; i < 5; ++i)
        EXPECT_EQ(set.add(box).index, i);
    set.remove(set.idAt(3));
    set.remove(set.idAt(1));
    EXPECT_FALSE(set.alive(1));
    EXPECT_EQ(set.size(), 5U);
    EXPECT_EQ(set.add(box).index, 1U);
    EXPECT_EQ(set.add(box).index, 3U);
    EXPECT_EQ(set.add(box).index, 5U);
    set.remove(set.idAt(5));
    EXPECT_EQ(set.size(), 5U);
    EXPECT_FALSE(set.alive(5));
    EXPECT_FALSE(set.alive(77));
}

TEST(ObjectSet, CountsChanges)
{
    ObjectSet set;
    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    const ObjectId a = set.add(box);
    const ObjectId b = set.add(box);
    EXPECT_EQ(set.version(), 2U);
    EXPECT_EQ(set.changed(a.index), 1U);
    set.update(a, box); // the same bounds
    EXPECT_EQ(set.version(), 2U);
    set.touch(a);
    EXPECT_EQ(set.changed(a.index), 3U);
    set.update(b, {{0, 0, 0}, {2, 1, 1}});
    EXPECT_EQ(set.changed(b.index), 4U);
    set.remove(a);
    EXPECT_EQ(set.version(), 5U);
    EXPECT_NE(set.identity(), ObjectSet().identity());
    const std::uint64_t identity = set.identity();
    const ObjectSet moved = std::move(set);
    EXPECT_EQ(moved.identity(), identity);
}

} // namespace
} // namespace gnomon
