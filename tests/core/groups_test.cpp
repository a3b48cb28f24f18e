// SPDX-License-Identifier: Apache-2.0
// Casters and lights in groups: a light's maps hold the casters of its groups alone.
#include "worlds.h"

#include <gnomon/object_ids.h>
#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace gnomon {
namespace {

Aabb boxAt(const glm::vec3& centre, float half)
{
    return {centre - half, centre + half};
}

/// A floor under two rows of boxes: those of even index in group 0, the others in group 3.
struct Hall {
    ObjectSet set;
    std::vector<ObjectId> boxes;
    std::vector<Light> lights;
    Frame frame;

    explicit Hall(LightType type)
    {
        set.add({{-12, -0.5F, -12}, {12, 0, 12}}, {.casts = false, .groups = 0});
        for (int i = 0; i < 12; ++i) {
            const auto x = static_cast<float>(i % 6) * 3.0F - 7.5F;
            boxes.push_back(set.add(boxAt({x, 1, i < 6 ? -3.0F : 3.0F}, 0.5F),
                                    {.dynamic = i % 3 == 0, .closed = true, .groups = i % 2 == 0 ? 1U : 8U}));
        }
        frame.objects = &set;
        frame.camera = test::perspectiveCamera({0, 14, 14}, {0, 0, 0}, 1.2);
        frame.size_px = {320, 200};
        lights.push_back(test::sun(glm::normalize(glm::dvec3(0.3, -1, 0.2))));
        lights[0].type = type;
        if (type != LightType::directional) {
            lights[0].position_ws = {0, 9, 0};
            lights[0].direction_ws = {0, -1, 0};
            lights[0].outer_half_angle_rad = 1.0;
            lights[0].range_m = 40.0;
        }
    }
    const Plan& plan(Planner& planner)
    {
        frame.lights = lights;
        return planner.plan(frame);
    }
};

/// Whom the plan draws or counts.
std::vector<std::uint32_t> castersOf(const Plan& plan)
{
    std::vector<std::uint32_t> casters = plan.casters;
    std::ranges::sort(casters);
    casters.erase(std::unique(casters.begin(), casters.end()), casters.end());
    return casters;
}

std::vector<ShadowOptions> allOptions()
{
    std::vector<ShadowOptions> all;
    for (const Partition partition : {Partition::single, Partition::cascades, Partition::sdsm, Partition::cube,
                                      Partition::paraboloid, Partition::multi, Partition::automatic}) {
        for (const Filter filter : {Filter::pcf, Filter::raymarch, Filter::vsm, Filter::id, Filter::volumes}) {
            for (const KeepStill keeps : {KeepStill::never, KeepStill::always}) {
                ShadowOptions options;
                options.technique = kPlainTechnique;
                options.technique.partition = partition;
                options.technique.filter = filter;
                options.keep_still = keeps;
                options.map_size = 512;
                if (resolve(options)) {
                    all.push_back(options);
                }
            }
        }
    }
    return all;
}

TEST(Groups, LeaveOthersOutOfEveryMapOfEveryPartition)
{
    int with_maps = 0;
    for (const LightType type : {LightType::directional, LightType::spot, LightType::point}) {
        for (const ShadowOptions& options : allOptions()) {
            Hall hall(type);
            const std::string which = std::string(nameOf(type)) + " " +
                                      std::string(nameOf(options.technique.partition)) + " " +
                                      std::string(nameOf(options.technique.filter));
            Planner planner(options);
            if (!hall.plan(planner).lights[0].outcome.hasMap()) {
                continue;
            }
            ++with_maps;
            const std::vector<std::uint32_t> all = castersOf(hall.plan(planner));
            for (const std::uint32_t groups : {1U, 8U}) {
                hall.lights[0].groups = groups;
                std::vector<std::uint32_t> wanted;
                std::ranges::copy_if(all, std::back_inserter(wanted), [&](std::uint32_t object) {
                    return (hall.set.flags(object).groups & groups) != 0;
                });
                EXPECT_FALSE(wanted.empty()) << which;
                EXPECT_EQ(castersOf(hall.plan(planner)), wanted) << which << ", groups " << groups;
            }
            hall.lights[0].groups = 4;
            EXPECT_FALSE(hall.plan(planner).lights[0].outcome.hasMap()) << which;
            EXPECT_TRUE(castersOf(hall.plan(planner)).empty()) << which;
        }
    }
    EXPECT_GE(with_maps, 60);
}

/// An object in no group is in no map, not even in that of a filter that draws receivers.
TEST(Groups, NoneAtAllIsNoCaster)
{
    for (const Filter filter : {Filter::pcf, Filter::vsm, Filter::id}) {
        for (const Motion motion : {Motion::free, Motion::snap}) {
            Hall hall(LightType::directional);
            ShadowOptions options;
            options.technique = kPlainTechnique;
            options.technique.filter = filter;
            options.technique.motion = motion;
            Planner planner(options);
            const auto isDrawn = [&] {
                return std::ranges::binary_search(castersOf(hall.plan(planner)), hall.boxes[0].index);
            };
            EXPECT_TRUE(isDrawn());
            ObjectFlags flags = hall.set.flags(hall.boxes[0]);
            flags.groups = 0;
            EXPECT_TRUE(hall.set.setFlags(hall.boxes[0], flags));
            EXPECT_FALSE(isDrawn());
            EXPECT_FALSE(std::ranges::binary_search(castersOf(hall.plan(planner)), 0U)) << "the floor";
        }
    }
}

/// Maps are drawn again in the frame in which a light's groups change, or an object's, and in no other.
TEST(Groups, ThatChangeAreDrawnAtOnce)
{
    for (const KeepStill keeps : {KeepStill::never, KeepStill::always}) {
        for (const std::size_t box : {std::size_t{0}, std::size_t{2}}) { // one that moves, one that stands still
            Hall hall(LightType::directional);
            ShadowOptions options;
            options.technique = kPlainTechnique;
            options.keep_still = keeps;
            Planner planner(options);
            const auto redraws = [&] {
                const Plan& plan = hall.plan(planner);
                return std::ranges::any_of(plan.views, [](const View& view) { return view.contents.redraw; });
            };
            EXPECT_TRUE(redraws());
            EXPECT_FALSE(redraws());
            hall.lights[0].groups = 1;
            EXPECT_TRUE(redraws());
            EXPECT_FALSE(redraws());
            ObjectFlags flags = hall.set.flags(hall.boxes[box]);
            flags.groups = 2;
            EXPECT_TRUE(hall.set.setFlags(hall.boxes[box], flags));
            EXPECT_TRUE(redraws());
            EXPECT_FALSE(redraws());
            EXPECT_TRUE(hall.set.setFlags(hall.boxes[box], flags));
            EXPECT_FALSE(redraws()) << "the same flags are no change";
        }
    }
}

/// A lamp's near distance follows those that cast for it.
TEST(Groups, AnotherGroupsBoxAtTheLampLeavesItsNearDistance)
{
    const auto nearOf = [](std::uint32_t groups) {
        Hall hall(LightType::point);
        hall.set.add(boxAt({0, 8.99F, 0}, 0.005F), {.groups = 16});
        hall.lights[0].groups = groups;
        ShadowOptions options;
        options.technique = kPlainTechnique;
        options.technique.partition = Partition::paraboloid;
        Planner planner(options);
        double near_m = 1e9;
        for (const View& view : hall.plan(planner).views) {
            near_m = std::min(near_m, view.projection.metric.near_m);
        }
        return near_m;
    };
    EXPECT_LT(nearOf(1 | 16), 0.01);
    EXPECT_GT(nearOf(1), 0.01);
}

TEST(Groups, OthersHaveTheGroundsId)
{
    Hall hall(LightType::directional);
    hall.lights[0].groups = 8;
    IdScratch scratch;
    std::vector<std::uint16_t> ids;
    handOutIds(hall.lights[0], hall.set, {}, scratch, ids);
    for (const ObjectId& box : hall.boxes) {
        EXPECT_EQ(ids[box.index] != 0, hall.set.flags(box).groups == 8) << box.index;
    }
}

TEST(Groups, FlagsChangeWhereAnObjectIsFound)
{
    ObjectSet set;
    const ObjectId here = set.add(boxAt({0, 0, 0}, 1), {});
    const ObjectId nowhere = set.add({}, {});
    const auto found = [&](ObjectSet::Want want) {
        std::vector<std::uint32_t> out;
        set.query({}, want, out);
        return out;
    };
    for (const bool dynamic : {true, false}) {
        EXPECT_TRUE(set.setFlags(here, {.casts = false, .receives = true, .dynamic = dynamic}));
        EXPECT_TRUE(found(ObjectSet::Want::casters).empty());
        EXPECT_EQ(found(ObjectSet::Want::receivers), std::vector<std::uint32_t>{here.index});
        EXPECT_TRUE(set.setFlags(here, {.casts = true, .receives = false, .dynamic = dynamic}));
        EXPECT_EQ(found(ObjectSet::Want::casters), std::vector<std::uint32_t>{here.index});
        EXPECT_TRUE(found(ObjectSet::Want::receivers).empty());
        EXPECT_EQ(set.nowhere(), 1U);
        EXPECT_EQ(set.bounds().max.x, 1.0F);
    }
    EXPECT_TRUE(set.setFlags(nowhere, {.receives = false}));
    EXPECT_TRUE(set.update(nowhere, boxAt({5, 0, 0}, 1)));
    EXPECT_TRUE(found(ObjectSet::Want::receivers).empty());
    const std::uint64_t version = set.version();
    EXPECT_TRUE(set.setFlags(nowhere, {.receives = false}));
    EXPECT_EQ(set.version(), version);
    EXPECT_TRUE(set.remove(nowhere));
    EXPECT_FALSE(set.setFlags(nowhere, {}));
}

} // namespace
} // namespace gnomon
