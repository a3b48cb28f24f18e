// SPDX-License-Identifier: Apache-2.0
// Names of objects that are gone, were never there or belong to another set; and objects whose bounds say nothing.
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <utility>

namespace gnomon {
namespace {

using test::Random;

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();
const Aabb kUnit{{0, 0, 0}, {1, 1, 1}};

/// Everything that takes an id says that there is no such object, and the set stays as it was.
void expectNothing(ObjectSet& set, ObjectId id)
{
    const std::uint64_t version = set.version();
    EXPECT_FALSE(set.alive(id));
    EXPECT_FALSE(set.update(id, {{5, 5, 5}, {6, 6, 6}}));
    EXPECT_FALSE(set.touch(id));
    EXPECT_FALSE(set.remove(id));
    EXPECT_TRUE(set.bounds(id).empty());
    EXPECT_FALSE(set.flags(id).casts || set.flags(id).receives || set.flags(id).dynamic);
    EXPECT_EQ(set.version(), version);
}

TEST(ObjectId, ThatNobodyGaveDoesNothing)
{
    ObjectSet set;
    const ObjectId id = set.add(kUnit);
    expectNothing(set, {});
    expectNothing(set, {id.index, 0});
    expectNothing(set, {id.index, id.generation + 1});
    for (const std::uint32_t index : {1U, 64U, 1U << 30, 0xFFFFFFFFU}) {
        expectNothing(set, {index, id.generation});
        EXPECT_FALSE(set.alive(index));
        EXPECT_TRUE(set.bounds(index).empty());
        EXPECT_FALSE(set.flags(index).casts);
        EXPECT_EQ(set.changed(index), 0U);
        EXPECT_FALSE(set.idAt(index));
    }
    EXPECT_TRUE(set.idAt(0));
    EXPECT_FALSE(ObjectId{});
}

TEST(ObjectId, OfAnotherSetDoesNothing)
{
    ObjectSet one;
    ObjectSet other;
    const ObjectId in_one = one.add(kUnit);
    const ObjectId in_other = other.add(kUnit);
    EXPECT_EQ(in_one.index, in_other.index);
    expectNothing(one, in_other);
    expectNothing(other, in_one);
}

TEST(ObjectId, ASetThatWasMovedFromIsEmptyAndCanBeUsed)
{
    ObjectSet set;
    const ObjectId id = set.add(kUnit);
    ObjectSet moved = std::move(set);
    EXPECT_TRUE(moved.alive(id));
    EXPECT_EQ(set.size(), 0U);
    EXPECT_TRUE(set.bounds().empty() && set.allBounds().empty() && set.allChanges().empty());
    EXPECT_EQ(set.version(), 0U);
    EXPECT_NE(set.identity(), moved.identity());
    std::vector<std::uint32_t> found;
    set.query({}, ObjectSet::Want::all, found);
    EXPECT_TRUE(found.empty());
    expectNothing(set, id);
    EXPECT_EQ(set.add(kUnit).index, 0U);
    EXPECT_NE(set.identity(), moved.identity());
}

/// Held against a plain list: whatever is called with whatever id.
TEST(ObjectId, RandomCallsWithOldIdsAgreeWithAPlainList)
{
    struct Known {
        ObjectId id;
        std::optional<Aabb> box; // while it lives
    };
    Random random(81);
    ObjectSet set;
    std::vector<Known> known;
    for (int i = 0; i < 20000; ++i) {
        const auto box = [&] {
            return test::boxAt(random.inBox(glm::dvec3(-50), glm::dvec3(50)), glm::dvec3(random.uniform(0.0, 3.0)));
        };
        if (known.empty() || random.below(5) == 0) {
            const Aabb made = box();
            known.push_back({set.add(made), made});
            continue;
        }
        Known& any = known[random.below(static_cast<std::uint32_t>(known.size()))];
        const bool lives = any.box.has_value();
        ASSERT_EQ(set.alive(any.id), lives);
        switch (random.below(4)) {
        case 0:
            ASSERT_EQ(set.remove(any.id), lives);
            any.box.reset();
            break;
        case 1:
            ASSERT_EQ(set.touch(any.id), lives);
            break;
        default:
            const Aabb next = box();
            ASSERT_EQ(set.update(any.id, next), lives);
            any.box = lives ? std::optional(next) : std::nullopt;
        }
        ASSERT_EQ(set.bounds(any.id).empty(), !any.box);
    }
    Aabb all;
    std::size_t alive = 0;
    for (const Known& one : known) {
        if (one.box) {
            all = merge(all, *one.box);
            ++alive;
            EXPECT_EQ(set.idAt(one.id.index), one.id);
        }
    }
    std::vector<std::uint32_t> found;
    set.query({}, ObjectSet::Want::all, found);
    EXPECT_EQ(found.size(), alive);
    EXPECT_EQ(set.bounds().min, all.min);
    EXPECT_EQ(set.bounds().max, all.max);
}

/// Bounds that are no place.
std::vector<Aabb> noPlaces()
{
    std::vector<Aabb> boxes{{},
                            {{1, 1, 1}, {0, 0, 0}}, // inside out
                            {{0, 0, 0}, {1, -1, 1}},
                            {{-kEndless, -kEndless, -kEndless}, {kEndless, kEndless, kEndless}}};
    for (const float bad : {kNoNumber, kEndless, -kEndless, 1e38F, -1e38F, 3.4e38F, 1.01F * kFarthestBounds_m}) {
        for (int axis = 0; axis < 3; ++axis) {
            boxes.push_back(kUnit);
            boxes.back().min[axis] = bad;
            boxes.push_back(kUnit);
            boxes.back().max[axis] = bad;
        }
        boxes.push_back({glm::vec3(bad), glm::vec3(bad)});
    }
    return boxes;
}

TEST(Nowhere, IsAliveAndInNoQueryAndComesBack)
{
    for (const Aabb& no_place : noPlaces()) {
        ObjectSet set;
        const ObjectId still = set.add(kUnit);
        const ObjectId lost = set.add(no_place, {.dynamic = true});
        ASSERT_EQ(set.nowhere(), 1U);
        std::vector<std::uint32_t> found;
        for (const bool comes_back : {false, true, false}) {
            if (comes_back) {
                EXPECT_TRUE(set.update(lost, {{2, 2, 2}, {3, 3, 3}}));
            } else {
                EXPECT_TRUE(set.update(lost, no_place));
            }
            const std::uint64_t version = set.version();
            EXPECT_TRUE(set.update(lost, set.bounds(lost)));
            EXPECT_EQ(set.version(), version);
            EXPECT_TRUE(set.alive(lost) && set.flags(lost).dynamic);
            EXPECT_EQ(set.bounds(lost).empty(), !comes_back);
            EXPECT_EQ(set.allBounds()[lost.index].empty(), !comes_back);
            EXPECT_EQ(set.nowhere(), comes_back ? 0U : 1U);
            EXPECT_EQ(set.bounds().max.x, comes_back ? 3.0F : 1.0F);
            found.clear();
            set.query({}, ObjectSet::Want::all, found);
            EXPECT_EQ(found.size(), comes_back ? 2U : 1U);
        }
        EXPECT_TRUE(set.remove(lost));
        EXPECT_EQ(set.nowhere(), 0U);
        EXPECT_TRUE(set.alive(still));
    }
}

/// They are small, large, thin or signed, and no less a place.
TEST(Nowhere, IsNotWhatIsOnlyAwkward)
{
    const float least = std::numeric_limits<float>::denorm_min();
    const float far = kFarthestBounds_m;
    for (const Aabb& box : {Aabb{{-0.0F, -0.0F, -0.0F}, {0, 0, 0}}, Aabb{{0, 0, 0}, {least, least, least}},
                            Aabb{{-far, -far, -far}, {far, far, far}}, Aabb{{far, far, far}, {far, far, far}},
                            Aabb{{-far, 0, 0}, {far, least, 0}}}) {
        ObjectSet set;
        for (int i = 0; i < 60; ++i) { // more than a cell holds undivided
            set.add(kUnit);
            set.add(box);
        }
        EXPECT_EQ(set.nowhere(), 0U);
        std::vector<std::uint32_t> found;
        set.query(std::vector<Plane>{{{1, 0, 0}, 3e12}}, ObjectSet::Want::casters, found);
        EXPECT_EQ(found.size(), 120U);
    }
}

/// A field of things under a sun and a lamp, planned; `lost` stands in its middle.
struct Field {
    ObjectSet set;
    ObjectId lost;
    std::vector<Light> lights{test::sun({0.4, -1, 0.2}), test::spot({3, 20, 0}, {0, -1, 0}, 0.8)};
    Frame frame;

    Field()
    {
        Random random(3);
        set.add({{-40, -0.5, -40}, {40, 0, 40}});
        for (int i = 0; i < 40; ++i) {
            set.add(test::boxAt(random.inBox({-35, 0.5, -35}, {35, 4, 35}), glm::dvec3(0.6)), {.dynamic = i % 4 == 0});
        }
        frame.camera = test::perspectiveCamera({20, 25, 30}, {0, 0, 0}, 1.0);
        frame.objects = &set;
        lights[1].key = 1;
    }
    Plan plan(const ShadowOptions& options)
    {
        Planner planner(options);
        frame.lights = lights;
        return planner.plan(frame);
    }
};

TEST(Nowhere, LeavesTheMapsOfItsNeighboursAsTheyAre)
{
    for (const Partition partition : {Partition::single, Partition::cascades}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = partition;
        options.technique.filter = Filter::msm; // measures level depth over all receivers
        options.technique.motion = Motion::snap;
        Field without;
        const std::string expected = toJson(without.plan(options));
        Field with;
        with.lost = with.set.add(kUnit, {.dynamic = true});
        for (const Aabb& no_place : noPlaces()) {
            ASSERT_TRUE(with.set.update(with.lost, no_place));
            Plan plan = with.plan(options);
            ASSERT_EQ(toJson(plan), expected);
            ASSERT_TRUE(with.set.update(with.lost, kUnit));
        }
        EXPECT_NE(toJson(with.plan(options)), expected);
    }
}

TEST(Nowhere, IsWhatAPlanWithoutReceiversSays)
{
    Field field;
    for (std::uint32_t i = 0; i < 41; ++i) {
        EXPECT_TRUE(field.set.update(field.set.idAt(i), {}));
    }
    EXPECT_EQ(field.set.nowhere(), 41U);
    const Plan plan = field.plan({});
    EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::no_receiver);
    EXPECT_EQ(plan.lights[0].outcome.reason,
              "the camera sees nothing that receives shadow, and some objects are nowhere (ObjectSet::nowhere())");
}

} // namespace
} // namespace gnomon
