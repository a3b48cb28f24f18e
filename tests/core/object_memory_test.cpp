// SPDX-License-Identifier: Apache-2.0
// A set of objects whose memory runs out has changed nothing, and goes on once there is some again.
#include "worlds.h"

#include "allocation_count.h"

#include <gnomon/object_set.h>

#include <gtest/gtest.h>

#include <new>
#include <vector>

namespace gnomon {
namespace {

constexpr int kCalls = 300;

/// The first try may find no memory; the second does.
template <class Call>
auto twice(Call call)
{
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return call();
    }
}

Aabb boxAt(test::Random& random, double reach)
{
    const glm::dvec3 low = random.inBox(glm::dvec3(-reach), glm::dvec3(reach));
    return {glm::vec3(low), glm::vec3(low + glm::dvec3(random.uniform(0.01, 3.0)))};
}

/// Adds, moves and removes, ever farther out, so that the tree grows upwards and downwards.
std::vector<Aabb> playOut(ObjectSet& set)
{
    test::Random random(7);
    std::vector<ObjectId> ids;
    for (int call = 0; call < kCalls; ++call) {
        const Aabb box = boxAt(random, 1.0 + call);
        const double choice = random.uniform(0.0, 1.0);
        if (ids.empty() || choice < 0.6) {
            const ObjectFlags flags{true, true, choice < 0.2};
            ids.push_back(twice([&] { return set.add(box, flags); }));
        } else if (choice < 0.9) {
            EXPECT_TRUE(twice([&] { return set.update(ids[static_cast<std::size_t>(call) % ids.size()], box); }));
        } else {
            EXPECT_TRUE(set.remove(ids.back()));
            ids.pop_back();
        }
    }
    std::vector<Aabb> found;
    std::vector<std::uint32_t> all;
    set.query({}, ObjectSet::Want::all, all);
    EXPECT_EQ(all.size(), ids.size());
    for (const std::uint32_t index : all) {
        found.push_back(set.bounds(index));
    }
    // The half in front of a plane: what the tree finds there is what looking at each finds.
    const Plane planes[] = {{glm::dvec3(1.0, 0.0, 0.0), 0.0}};
    std::vector<std::uint32_t> half;
    set.query(planes, ObjectSet::Want::all, half);
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t index : all) {
        if (set.bounds(index).max.x >= 0.0F) {
            expected.push_back(index);
        }
    }
    EXPECT_EQ(half, expected);
    return found;
}

TEST(ObjectMemory, ThatRunsOutChangesNothing)
{
    ObjectSet whole;
    const std::vector<Aabb> expected = playOut(whole);
    int points = 0;
    for (std::uint64_t nth = 1;; ++nth) {
        ObjectSet set;
        std::vector<Aabb> found;
        bool failed = false;
        {
            test::FailingAllocation failing(nth);
            try {
                found = playOut(set);
            } catch (const std::bad_alloc&) {
                continue; // of the test's own lists
            }
            failed = test::FailingAllocation::failed();
        }
        ASSERT_EQ(found.size(), expected.size()) << "allocation " << nth;
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_TRUE(found[i].min == expected[i].min && found[i].max == expected[i].max) << "allocation " << nth;
        }
        if (!failed) {
            break;
        }
        ++points;
    }
    EXPECT_GT(points, 10);
}

} // namespace
} // namespace gnomon
