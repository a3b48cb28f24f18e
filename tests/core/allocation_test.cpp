// SPDX-License-Identifier: Apache-2.0
// Steady-state planning takes nothing from the heap.
#include "allocation_count.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace gnomon {
namespace {

TEST(Allocation, TheCounterCounts)
{
    const std::uint64_t before = test::heapAllocations();
    std::vector<int> some(100);
    EXPECT_EQ(some.size(), 100U);
    EXPECT_GT(test::heapAllocations(), before);
}

TEST(Allocation, SteadyStatePlansTakeNothingFromTheHeap)
{
    test::Random random(20);
    ObjectSet set;
    set.add({{-200, -3, -200}, {200, 5, 200}});
    std::vector<glm::dvec3> homes;
    for (int i = 0; i < 2000; ++i) {
        homes.push_back(random.inBox({-190, 0, -190}, {190, 30, 190}));
        set.add(test::boxAt(homes.back(), glm::dvec3(1.0)), {true, true, i % 2 == 0});
    }
    const std::vector<Light> lights{test::sun({0.4, -1, 0.3}), test::spot({0, 40, 0}, {0.2, -1, 0}, 0.9)};
    Frame frame;
    frame.lights = lights;
    frame.objects = &set;
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.fit = fit;
        Planner planner(options);
        const auto play = [&](int step) {
            const double turn = 6.283185307179586 * step / 60.0;
            for (std::uint32_t i = 0; i < homes.size(); i += 2) {
                const glm::dvec3 away(8.0 * std::cos(turn + i), 0.0, 8.0 * std::sin(turn + i));
                set.update(set.idAt(i + 1), test::boxAt(homes[i] + away, glm::dvec3(1.0)));
            }
            frame.camera = test::perspectiveCamera({150 * std::cos(turn), 60, 150 * std::sin(turn)}, {0, 0, 0}, 1.0);
            return planner.plan(frame).casters.size();
        };
        for (int step = 0; step < 120; ++step)
            (void)play(step % 60);
        const std::uint64_t before = test::heapAllocations();
        std::size_t casters = 0;
        for (int step = 0; step < 60; ++step)
            casters += play(step);
        EXPECT_EQ(test::heapAllocations(), before);
        EXPECT_GT(casters, 10000U);
    }
}

/// The memory of auto goes on for some laps before one equals the last.
TEST(Allocation, SteadyStatePlansOfAutoTakeNothingFromTheHeap)
{
    test::Random random(22);
    ObjectSet set;
    set.add({{-200, -3, -200}, {200, 5, 200}});
    for (int i = 0; i < 2000; ++i)
        set.add(test::boxAt(random.inBox({-190, 0, -190}, {190, 30, 190}), glm::dvec3(1.0)));
    const std::vector<Light> lights{test::sun({0.4, -1, 0.3}), test::spot({0, 40, 0}, {0.2, -1, 0}, 0.9)};
    Frame frame;
    frame.lights = lights;
    frame.objects = &set;
    for (const Quality quality : {Quality::fast, Quality::balanced, Quality::best}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = Partition::automatic;
        options.technique.fit = Fit::automatic;
        options.quality = quality;
        Planner planner(options);
        const auto lap = [&] {
            for (int step = 0; step < 60; ++step) {
                const double turn = 6.283185307179586 * step / 60.0;
                frame.camera =
                    test::perspectiveCamera({150 * std::cos(turn), 60, 150 * std::sin(turn)}, {0, 0, 0}, 1.0);
                (void)planner.plan(frame);
            }
        };
        for (int i = 0; i < 10; ++i)
            lap();
        const std::uint64_t before = test::heapAllocations();
        lap();
        EXPECT_EQ(test::heapAllocations(), before) << nameOf(quality);
    }
}

/// The sun goes to and fro, things move, and what stands still is kept.
TEST(Allocation, SteadyStatePlansOfSteppingSunsTakeNothingFromTheHeap)
{
    test::Random random(21);
    ObjectSet set;
    set.add({{-200, -3, -200}, {200, 5, 200}});
    std::vector<glm::dvec3> homes;
    for (int i = 0; i < 400; ++i) {
        homes.push_back(random.inBox({-150, 0, -150}, {150, 30, 150}));
        set.add(test::boxAt(homes.back(), glm::dvec3(1.0)), {true, true, i % 4 == 0});
    }
    std::vector<Light> lights{test::sun({0.4, -1, 0.3}), test::spot({0, 40, 0}, {0.2, -1, 0}, 0.9)};
    Frame frame;
    frame.lights = lights;
    frame.objects = &set;
    frame.camera = test::perspectiveCamera({150, 60, 0}, {0, 0, 0}, 1.0);
    for (const Motion motion : {Motion::step_jump, Motion::step_band, Motion::step_blend, Motion::step_alternate}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.motion = motion;
        options.keep_still = KeepStill::always;
        Planner planner(options);
        int drawn = 0;
        const auto play = [&](int step) {
            const double turn = 6.283185307179586 * step / 60.0;
            for (std::uint32_t i = 0; i < homes.size(); i += 4) {
                const glm::dvec3 away(8.0 * std::cos(turn + i), 0.0, 8.0 * std::sin(turn + i));
                set.update(set.idAt(i + 1), test::boxAt(homes[i] + away, glm::dvec3(1.0)));
            }
            lights[0].direction_ws = glm::normalize(glm::dvec3(0.4 + 0.02 * std::sin(turn), -1.0, 0.3));
            for (const View& view : planner.plan(frame).views)
                drawn += view.contents.redraw_kept ? 1 : 0;
        };
        for (int step = 0; step < 600; ++step)
            play(step % 60);
        drawn = 0;
        const std::uint64_t before = test::heapAllocations();
        for (int step = 0; step < 120; ++step)
            play(step % 60);
        EXPECT_EQ(test::heapAllocations(), before) << nameOf(motion);
        EXPECT_GT(drawn, 4);
    }
}

} // namespace
} // namespace gnomon
