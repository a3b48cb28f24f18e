// SPDX-License-Identifier: Apache-2.0
// A sun in steps by time, in a band and in jumps, and several suns.
#include "suns.h"
#include "worlds.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using namespace test;

TEST(SunStepsByTime, TakeAStepInEachInterval)
{
    SunCourse course;
    constexpr double kFrame_s = 0.017; // does not divide the interval
    constexpr double kSpeed = 0.004;   // radians a second
    int steps = 0;
    double began_s = 0.0;
    for (int frame = 0; frame < 3000; ++frame) {
        const double now_s = 1000.0 + frame * kFrame_s;
        const double at = -0.1 + kSpeed * frame * kFrame_s;
        const auto before = shown(course);
        const std::uint32_t slot = course.earlierSlot();
        course.follow(overhead(at), now_s, Stepping::blend, byTime(2.0));
        const SunSteps& now = course.steps();
        steps += slot != course.earlierSlot() ? 1 : 0;
        if (!now.paired) {
            EXPECT_LT(now_s - 1000.0, 2.0 * (2.0 / 32.0 + kFrame_s)); // two measures of its speed
            began_s = now_s + kFrame_s;
            continue;
        }
        EXPECT_LE(change(before, shown(course)), kFrame_s / 2.0 + 1e-6);
        EXPECT_NEAR(now.share + steps, (now_s - began_s) / 2.0, 1e-6);
        if (steps > 0) {
            EXPECT_NEAR(angleBetween(now.earlier_ws, now.later_ws), kSpeed * 2.0, 1e-9);
            EXPECT_NEAR(angleBetween(mean(now), overhead(at)), 0.0, 1e-7);
        }
    }
    EXPECT_EQ(steps, 25);
}

TEST(SunStepsByTime, OfASunThatStopsEndWhereItStands)
{
    SunCourse course;
    int frame = 0;
    for (; frame < 100; ++frame)
        course.follow(overhead(0.001 * frame), 0.1 * frame, Stepping::blend, byTime(2.0));
    const glm::dvec3 there = overhead(0.001 * 99);
    for (; frame < 150; ++frame) {
        const auto before = shown(course);
        course.follow(there, 0.1 * frame, Stepping::blend, byTime(2.0));
        EXPECT_LE(change(before, shown(course)), 0.05 + 1e-6);
    }
    EXPECT_FALSE(course.steps().paired);
    EXPECT_EQ(course.steps().earlier_ws, there);
    // A first nudge of less than a jump: blended over.
    const glm::dvec3 nudged = overhead(0.001 * 99 + 0.005);
    for (; frame < 180; ++frame) {
        const auto before = shown(course);
        course.follow(nudged, 0.1 * frame, Stepping::blend, byTime(2.0));
        EXPECT_LE(change(before, shown(course)), 0.05 + 1e-6);
        EXPECT_LE(angleBetween(mean(course.steps()), nudged), 0.005 + 1e-9); // nowhere else meanwhile
    }
    EXPECT_FALSE(course.steps().paired);
    EXPECT_EQ(course.steps().earlier_ws, nudged);
}

/// A nudge at any time of the step is no speed: the next position is not thrown far ahead.
TEST(SunStepsByTime, OfASunThatIsNudgedGoOn)
{
    for (int nudge = 100; nudge < 130; ++nudge) {
        SunCourse course;
        for (int frame = 0; frame < 200; ++frame) {
            const glm::dvec3 sun = overhead(0.0005 * frame + (frame < nudge ? 0.0 : 0.008));
            course.follow(sun, 0.1 * frame, Stepping::blend, byTime(2.0));
            // As far as it goes in an interval, and the nudge.
            EXPECT_LE(angleBetween(course.steps().later_ws, sun), 0.0005 * 20.0 + 0.008 + 1e-9)
                << nudge << " " << frame;
        }
    }
}

TEST(SunStepsByTime, BeginAnewWhenTimeDoes)
{
    for (const double to_s : {3.0, 100.0, -1e300, 1e300, kNan, std::numeric_limits<double>::infinity()}) {
        SunCourse course;
        const auto play = [&](int frame, double time_s) {
            course.follow(overhead(0.001 * frame), time_s, Stepping::blend, byTime(2.0));
        };
        for (int frame = 0; frame < 100; ++frame)
            play(frame, 0.1 * frame);
        ASSERT_TRUE(course.steps().paired);
        play(100, to_s);
        EXPECT_FALSE(course.steps().paired) << to_s;
        EXPECT_EQ(course.steps().earlier_ws, overhead(0.1));
        for (int frame = 101; frame < 200; ++frame) {
            play(frame, std::abs(to_s) < 1e6 ? to_s + 0.1 * (frame - 100) : 0.1 * frame);
            EXPECT_GE(course.steps().share, 0.0);
            EXPECT_LE(course.steps().share, 1.0);
        }
        EXPECT_TRUE(course.steps().paired);
        EXPECT_LT(angleBetween(mean(course.steps()), overhead(0.199)), 1e-6);
    }
}

TEST(SunStepsByTime, OfASunThatJumpsOrRacesStandAlone)
{
    SunCourse course;
    for (int frame = 0; frame < 100; ++frame)
        course.follow(overhead(0.001 * frame), 0.1 * frame, Stepping::blend, byTime(2.0));
    course.follow(overhead(1.0), 10.0, Stepping::blend, byTime(2.0));
    EXPECT_FALSE(course.steps().paired);
    EXPECT_EQ(course.steps().earlier_ws, overhead(1.0));
    // A radian a second: two of them in a step are no step.
    for (int frame = 1; frame < 100; ++frame) {
        course.follow(overhead(1.0 + 0.1 * frame), 10.0 + 0.1 * frame, Stepping::blend, byTime(2.0));
        EXPECT_LE(angleBetween(course.steps().earlier_ws, overhead(1.0 + 0.1 * frame)), 0.11);
        EXPECT_LE(angleBetween(course.steps().later_ws, overhead(1.0 + 0.1 * frame)), 0.5);
    }
}

TEST(SunSteps, WithinABandSweepOverThePicture)
{
    SunCourse course;
    StepOptions options = byAngle();
    options.band = 0.3;
    const auto weight = [&](double x) {
        const SunSteps& s = course.steps();
        return std::clamp((s.edge - x) / s.band, 0.0, 1.0);
    };
    for (int frame = 0; frame < 40; ++frame) {
        course.follow(overhead(0.11 * kStep * frame), frame, Stepping::band, options);
        if (!course.steps().paired) {
            EXPECT_EQ(course.steps().band, 0.0);
            continue;
        }
        ASSERT_EQ(course.steps().band, 0.3);
        EXPECT_NEAR(course.steps().edge, course.steps().share * 1.3, 1e-15);
        EXPECT_LE(weight(1.0), weight(0.0)); // the left side is first
    }
    course = {};
    course.follow(overhead(0.0), 0, Stepping::band, options);
    course.follow(overhead(0.1 * kStep), 0, Stepping::band, options); // the share is 0 here
    EXPECT_EQ(weight(0.0), 0.0);
    course.follow(overhead(1.1 * kStep - 1e-12), 0, Stepping::band, options);
    course.follow(overhead(0.6 * kStep), 0, Stepping::blend, options);
    EXPECT_EQ(course.steps().band, 0.0);
}

TEST(SunJumps, AreHalfAStepAheadAtMost)
{
    SunCourse course;
    int jumps = 0;
    constexpr double kMove = 0.0371 * kStep;
    glm::dvec3 last(0.0);
    for (int frame = 0; frame < 3000; ++frame) {
        const double at = -1.0 + kMove * frame;
        course.follow(overhead(at), frame, Stepping::jump, byAngle());
        const SunSteps& now = course.steps();
        EXPECT_TRUE(now.stepping);
        EXPECT_FALSE(now.paired);
        EXPECT_FALSE(now.alternate);
        EXPECT_LE(angleBetween(now.earlier_ws, overhead(at)), (0.5 + 1.0 / 16.0) * kStep + kMove);
        if (frame > 0 && now.earlier_ws != last) {
            ++jumps;
            EXPECT_NEAR(angleBetween(last, now.earlier_ws), kStep, 1e-9);
        }
        last = now.earlier_ws;
    }
    EXPECT_NEAR(jumps, 3000 * 0.0371, 1.0);
    // To and fro about where it jumped last: nothing.
    const double at = -1.0 + kMove * 2999;
    course.follow(overhead(at), 0, Stepping::jump, byAngle());
    Random random(4);
    const double half = at + (angleBetween(last, overhead(at)) - 0.5 * kStep); // near the middle between two
    course.follow(overhead(half), 0, Stepping::jump, byAngle());
    last = course.steps().earlier_ws;
    for (int frame = 0; frame < 300; ++frame) {
        course.follow(overhead(half + random.uniform(-0.03, 0.03) * kStep), 0, Stepping::jump, byAngle());
        EXPECT_EQ(course.steps().earlier_ws, last);
    }
    course.follow(overhead(0.2), 0, Stepping::jump, byAngle());
    EXPECT_EQ(course.steps().earlier_ws, overhead(0.2));
}

TEST(SunJumps, ByTimeComeInTheMiddleOfTheInterval)
{
    SunCourse course;
    constexpr double kSpeed = 0.01;
    int jumps = 0;
    glm::dvec3 last(0.0);
    for (int frame = 0; frame < 1000; ++frame) {
        const double at = kSpeed * 0.05 * frame;
        course.follow(overhead(at), 0.05 * frame, Stepping::jump, byTime(2.0));
        jumps += frame > 0 && course.steps().earlier_ws != last ? 1 : 0;
        last = course.steps().earlier_ws;
        EXPECT_LE(angleBetween(last, overhead(at)), kSpeed * 1.0 + kSpeed * 0.05);
    }
    EXPECT_EQ(jumps, 25);
    for (int frame = 1000; frame < 1100; ++frame) // it stops
        course.follow(overhead(kSpeed * 0.05 * 999), 0.05 * frame, Stepping::jump, byTime(2.0));
    EXPECT_EQ(course.steps().earlier_ws, overhead(kSpeed * 0.05 * 999));
}

TEST(SunCourses, AreToldApartByKeyAndForgotten)
{
    SunCourses courses;
    std::array<Light, 3> lights;
    lights[0].key = 7;
    lights[1].key = 7; // two of one key: by their order
    lights[2].key = 9;
    for (int frame = 0; frame < 50; ++frame) {
        for (std::size_t i = 0; i < 3; ++i)
            lights[i].direction_ws =
                overhead(static_cast<double>(i) + (0.05 + 0.01 * static_cast<double>(i)) * kStep * frame);
        courses.begin();
        const std::array<std::size_t, 3> order =
            frame % 2 == 0 ? std::array<std::size_t, 3>{0, 1, 2} : std::array<std::size_t, 3>{2, 0, 1};
        for (const std::size_t i : order) {
            const SunCourse& course = courses.follow(lights[i], frame, Stepping::blend, byAngle());
            EXPECT_LT(angleBetween(mean(course.steps()), lights[i].direction_ws), 0.075 * kStep);
            EXPECT_EQ(course.steps().paired, frame > 0) << frame << " " << i;
        }
        courses.end();
    }
    courses.begin();
    (void)courses.follow(lights[2], 50, Stepping::blend, byAngle());
    courses.end();
    courses.begin();
    EXPECT_FALSE(courses.follow(lights[0], 51, Stepping::blend, byAngle()).steps().paired);
    EXPECT_TRUE(courses.follow(lights[2], 51, Stepping::blend, byAngle()).steps().paired);
    courses.end();
}

} // namespace
} // namespace gnomon
