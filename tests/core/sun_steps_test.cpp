// SPDX-License-Identifier: Apache-2.0
// A sun in steps by angle: what is shown is where the sun is, no step is seen, and no position's map is lost while it
// counts.
#include "suns.h"
#include "worlds.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using namespace test;

TEST(SunRotation, TurnsByTheAngleAboutTheAxis)
{
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 axis = random.direction();
        const glm::dvec3 v = random.direction();
        const double angle = random.uniform(-1.0, 1.0);
        const glm::dvec3 turned = rotated(v, axis, angle);
        EXPECT_NEAR(glm::dot(turned, axis), glm::dot(v, axis), 1e-14);
        EXPECT_NEAR(glm::distance(rotated(turned, axis, -angle), v), 0.0, 1e-14);
        EXPECT_EQ(rotated(v, axis, 0.0), v);
        const glm::dvec3 across = glm::normalize(glm::cross(axis, v));
        EXPECT_NEAR(angleBetween(across, rotated(across, axis, angle)), std::abs(angle), 1e-14);
    }
    EXPECT_NEAR(angleBetween(overhead(0.0), overhead(1e-9)), 1e-9, 1e-20);
    EXPECT_NEAR(angleBetween(overhead(0.0), overhead(kPi)), kPi, 1e-12);
}

/// On a great circle all can be told: after the first step each position is one step from the one before, and the share
/// is the angle that the sun has gone between them.
TEST(SunStepsByAngle, AreEvenOnAGreatCircle)
{
    SunCourse course;
    constexpr double kMove = kStep * 0.037;
    double first_begin = 0.0; // where the first pair began
    int steps = 0;
    for (int frame = 0; frame < 3000; ++frame) {
        const double at = -1.0 + frame * kMove; // through the zenith on the way
        const std::uint32_t slot = course.earlierSlot();
        course.follow(overhead(at), frame, Stepping::blend, byAngle());
        const SunSteps& now = course.steps();
        steps += slot != course.earlierSlot() ? 1 : 0;
        if (!now.paired) {
            EXPECT_LT(at + 1.0, kStep / 32.0);
            first_begin = at + kMove;
            continue;
        }
        const double gone = (at - first_begin) / kStep;
        EXPECT_EQ(steps, static_cast<int>(gone + 1e-9));
        EXPECT_NEAR(now.share, gone - steps, 1e-7);
        EXPECT_NEAR(angleBetween(now.later_ws, overhead(first_begin + (steps + 1) * kStep)), 0.0, 1e-12);
        if (steps > 0) {
            EXPECT_NEAR(angleBetween(now.earlier_ws, overhead(first_begin + steps * kStep)), 0.0, 1e-12);
            EXPECT_NEAR(angleBetween(mean(now), overhead(at)), 0.0, 1e-8);
        }
    }
    EXPECT_GT(steps, 100);
}

/// A day and a night, the sun on a small circle: nothing lags and nothing drifts off. A great circle leaves a small one
/// of radius r by x^2 / 2 cot r on x; here that is cot of 78 degrees.
TEST(SunStepsByAngle, FollowTheSunThroughDayAndNight)
{
    for (const double step : {kStep, 0.0001, 0.1}) {
        SunCourse course;
        const double move = 0.07 * step;
        const int frames = std::min(20000, static_cast<int>(2.0 * kPi / move));
        std::array<Weighed, 2> before{};
        int steps = 0;
        for (int frame = 0; frame < frames; ++frame) {
            const glm::dvec3 sun = sunAt(frame * move / std::cos(0.2));
            const std::uint32_t slot = course.earlierSlot();
            course.follow(sun, 0.0, Stepping::blend, byAngle(step));
            steps += slot != course.earlierSlot() ? 1 : 0;
            if (frame > 0) {
                EXPECT_LE(change(before, shown(course)), 0.07 + 1e-6) << frame;
            }
            if (steps > 0) {
                EXPECT_LE(angleBetween(mean(course.steps()), sun), step * step) << frame;
            }
            before = shown(course);
        }
        EXPECT_NEAR(steps, frames * 0.07, 0.02 * frames * 0.07 + 2.0);
    }
}

TEST(SunStepsByAngle, OfASunThatStandsAreOne)
{
    SunCourse course;
    for (int frame = 0; frame < 100; ++frame) {
        course.follow(sunAt(0.3), frame, Stepping::blend, byAngle());
        EXPECT_TRUE(course.steps().stepping);
        EXPECT_FALSE(course.steps().paired);
        EXPECT_EQ(course.steps().share, 0.0);
        EXPECT_EQ(course.steps().earlier_ws, sunAt(0.3));
    }
    // One that trembles by the rounding of a float, too.
    Random random(5);
    for (int frame = 0; frame < 1000; ++frame) {
        course.follow(glm::normalize(sunAt(0.3) + 6e-8 * random.direction()), frame, Stepping::blend, byAngle());
        EXPECT_FALSE(course.steps().paired);
    }
}

TEST(SunStepsByAngle, OfASunThatTurnsBackGoBackWithIt)
{
    SunCourse course;
    const auto at = [](int frame) {
        return 3.4 * kStep * std::sin(0.01 * frame);
    };
    int unlike = 0;
    for (int frame = 0; frame <= 314; ++frame) {
        const auto before = shown(course);
        course.follow(overhead(at(frame)), frame, Stepping::blend, byAngle());
        if (frame == 0)
            continue;
        EXPECT_LE(change(before, shown(course)), std::abs(at(frame) - at(frame - 1)) / kStep + 1e-7) << frame;
        // A quarter of a step that is not followed, and a 32nd in which the turn is not yet known.
        EXPECT_LE(angleBetween(mean(course.steps()), overhead(at(frame))), 0.3 * kStep) << frame;
        unlike += angleBetween(mean(course.steps()), overhead(at(frame))) > 1e-4 * kStep ? 1 : 0;
    }
    EXPECT_GT(unlike, 10); // the quarter does come up
}

TEST(SunStepsByAngle, OfASunThatTremblesDrawNothing)
{
    SunCourse course;
    for (int frame = 0; frame < 40; ++frame)
        course.follow(overhead(0.11 * kStep * frame), frame, Stepping::blend, byAngle());
    // About where the last step began.
    const double begun = 39 * 0.11 * kStep - course.steps().share * kStep;
    const SunSteps steps = course.steps();
    Random random(2);
    for (int frame = 0; frame < 300; ++frame) {
        course.follow(overhead(begun + random.uniform(-0.1, 0.1) * kStep), 40 + frame, Stepping::blend, byAngle());
        EXPECT_EQ(course.steps().earlier_ws, steps.earlier_ws);
        EXPECT_EQ(course.steps().later_ws, steps.later_ws);
    }
}

TEST(SunStepsByAngle, OfASunThatJumpsBeginAnew)
{
    for (const double jump : {1.0, 1.7, 40.0, 300.0}) {
        SunCourse course;
        for (int frame = 0; frame < 40; ++frame)
            course.follow(overhead(0.11 * kStep * frame), frame, Stepping::blend, byAngle());
        ASSERT_TRUE(course.steps().paired);
        const glm::dvec3 there = overhead((39 * 0.11 + jump) * kStep);
        course.follow(there, 40.0, Stepping::blend, byAngle());
        EXPECT_FALSE(course.steps().paired);
        EXPECT_EQ(course.steps().earlier_ws, there);
        // And goes on, the other way.
        for (int frame = 1; frame < 30; ++frame) {
            const double at = (39 * 0.11 + jump - 0.11 * frame) * kStep;
            course.follow(overhead(at), 40.0 + frame, Stepping::blend, byAngle());
            ASSERT_TRUE(course.steps().paired);
            EXPECT_LE(angleBetween(mean(course.steps()), overhead(at)), 0.12 * kStep);
        }
    }
}

/// The sun goes straight on for a while, then turns by any angle. After a turn across the way the share stands still
/// for a quarter of a step and takes another one to its nearer end, which is half a step away at most. So the lag is
/// less than a step, with the moves of some frames, where it had gone before the turn.
TEST(SunStepsByAngle, OfASunThatStrollsAreNeverSeen)
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Random random(seed);
        const bool often = seed <= 20; // too often for a lag to go
        SunCourse course;
        glm::dvec3 sun = random.direction();
        glm::dvec3 heading = random.direction();
        double straight = 0.0;
        for (int frame = 0; frame < 3000; ++frame) {
            const auto before = shown(course);
            course.follow(sun, frame, Stepping::blend, byAngle());
            if (frame > 0) {
                ASSERT_LE(change(before, shown(course)), 2.0 * 0.1 + 1e-6) << "seed " << seed << " frame " << frame;
            }
            if (!often) {
                ASSERT_LT(angleBetween(mean(course.steps()), sun), kStep) << "seed " << seed << " frame " << frame;
            }
            const double move = random.uniform(0.0, 0.1);
            straight += move;
            if (often ? random.below(static_cast<std::uint32_t>(seed)) == 0 : straight > random.uniform(3.0, 6.0)) {
                heading = random.direction();
                straight = 0.0;
            }
            heading = glm::normalize(heading - sun * glm::dot(heading, sun));
            sun = glm::normalize(sun + heading * (move * kStep));
        }
    }
}

} // namespace
} // namespace gnomon
