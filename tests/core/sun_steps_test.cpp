// SPDX-License-Identifier: Apache-2.0
// A sun in steps: what is shown is where the sun is, no step is seen, and no position's map is lost while it counts.
#include "motion/sun_steps.h"
#include "worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

using test::Random;

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.00872664626;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The sun of 50 degrees north, so many days after the equinox's quarter: hour angle 0 is noon, pi midnight, when it
/// shines from below.
glm::dvec3 sunAt(double hour_angle, double declination = 0.2)
{
    const double north = glm::radians(50.0);
    const glm::dvec3 pole(0.0, std::sin(north), -std::cos(north));
    const glm::dvec3 south(0.0, std::cos(north), std::sin(north)); // on the equator of the sky, at noon
    const glm::dvec3 toward =
        pole * std::sin(declination) +
        (south * std::cos(hour_angle) + glm::cross(south, pole) * std::sin(hour_angle)) * std::cos(declination);
    return -glm::normalize(toward);
}

/// On a great circle through the zenith.
glm::dvec3 overhead(double angle)
{
    return {std::sin(angle), -std::cos(angle), 0.0};
}

StepOptions byAngle(double step_rad = kStep)
{
    StepOptions options;
    options.angle_rad = step_rad;
    return options;
}

StepOptions byTime(double interval_s)
{
    StepOptions options;
    options.by = StepBy::time;
    options.interval_s = interval_s;
    return options;
}

struct Weighed {
    glm::dvec3 place_ws;
    double weight;
    std::uint32_t slot;
};

/// What a frame shows: which positions, how much each (without smoothing), and where their maps are.
std::array<Weighed, 2> shown(const SunCourse& course)
{
    const SunSteps& steps = course.steps();
    return {Weighed{steps.earlier_ws, 1.0 - steps.share, course.earlierSlot()},
            Weighed{steps.later_ws, steps.share, 1 - course.earlierSlot()}};
}

/// The share of what is shown that is not what was: 0 .. 1. Positions are the same if all their bits are.
double change(const std::array<Weighed, 2>& before, const std::array<Weighed, 2>& after)
{
    double kept = 0.0;
    for (const Weighed& a : before)
        for (const Weighed& b : after)
            if (a.place_ws == b.place_ws && a.slot == b.slot)
                kept += std::min(a.weight, b.weight);
    return 1.0 - kept;
}

/// The place on the arc between the two positions that the share says.
glm::dvec3 mean(const SunSteps& steps)
{
    const double whole = angleBetween(steps.earlier_ws, steps.later_ws);
    if (whole == 0.0)
        return steps.earlier_ws;
    const glm::dvec3 axis = glm::normalize(glm::cross(steps.earlier_ws, steps.later_ws));
    return rotated(steps.earlier_ws, axis, steps.share * whole);
}

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

TEST(SunStepsByAngle, OfASunThatStopsStayAsTheyAre)
{
    SunCourse course;
    for (int frame = 0; frame <= 100; ++frame)
        course.follow(overhead(0.013 * kStep * frame), frame, Stepping::blend, byAngle());
    const auto before = shown(course);
    EXPECT_GT(course.steps().share, 0.2);
    for (int frame = 0; frame < 100; ++frame) {
        course.follow(overhead(1.3 * kStep), 100 + frame, Stepping::blend, byAngle());
        EXPECT_LT(change(before, shown(course)), 1e-12);
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

/// Straight on for a while, then a turn, of any angle. Of a turn across the way the share stands still for a quarter of
/// a step and takes another one to its nearer end, which is half a step away at most: so the lag is less than a step,
/// the moves of some frames included, where it had gone before the turn.
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

TEST(SunStepsByTime, TakeAStepInEachInterval)
{
    SunCourse course;
    constexpr double kFrame_s = 1.0 / 60.0;
    constexpr double kSpeed = 0.004; // radians a second
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
    EXPECT_EQ(steps, 24);
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
