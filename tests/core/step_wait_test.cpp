// SPDX-License-Identifier: Apache-2.0
// Jumps that wait for the camera to move: when they come, how far the sun is off meanwhile, and that a plan knows.
#include "hostile_world.h"
#include "suns.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <set>

namespace gnomon {
namespace {

using namespace test;

StepOptions waiting(StepOptions options, double longest_s)
{
    options.wait = StepWait::camera;
    options.longest_wait_s = longest_s;
    return options;
}

/// A sun overhead at an even speed, a frame a tenth of a second, and a camera that moves now and then.
struct Walk {
    double speed_rad_s = 0.02 * kStep / 0.1;
    int stop = 0; // frames of standing
    int go = 1;   // and of moving, by turns
    double now_s = 0.0;
    int frame = 0;
    SunCourse course;

    [[nodiscard]] bool moves() const { return frame % (stop + go) >= stop; }
    /// Returns whether a jump was taken.
    bool next(const StepOptions& options)
    {
        const glm::dvec3 before = course.steps().earlier_ws;
        const bool first = frame == 0;
        course.follow(sun(), now_s, Stepping::jump, options, moves());
        return !first && course.steps().earlier_ws != before;
    }
    void pass()
    {
        ++frame;
        now_s = 0.1 * frame;
    }
    [[nodiscard]] glm::dvec3 sun() const { return overhead(-0.5 + speed_rad_s * now_s); }
    [[nodiscard]] double off_rad() const { return angleBetween(course.steps().earlier_ws, sun()); }
};

TEST(StepWait, JumpsOnlyWhileTheCameraMoves)
{
    for (const bool by_time : {false, true}) {
        const StepOptions options = waiting(by_time ? byTime(5.0) : byAngle(), 1e4);
        Walk walk;
        walk.stop = 137;
        walk.go = 9;
        int jumps = 0;
        for (; walk.frame < 4000; walk.pass()) {
            if (walk.next(options)) {
                EXPECT_TRUE(walk.moves()) << walk.frame;
                EXPECT_LE(walk.off_rad(), 0.5 * kStep + 1e-9);
                ++jumps;
            }
        }
        EXPECT_EQ(jumps, 4000 / 146) << by_time; // the first frame that may: one for each walk
    }
}

TEST(StepWait, WaitsNoLongerThanItIsTold)
{
    for (const bool by_time : {false, true}) {
        for (const double longest_s : {0.0, 3.0, 20.0}) {
            const StepOptions options = waiting(by_time ? byTime(5.0) : byAngle(), longest_s);
            Walk walk;
            walk.stop = 100000;
            int jumps = 0;
            for (; walk.frame < 4000; walk.pass()) {
                jumps += walk.next(options) ? 1 : 0;
                // Due where the sun is half a step past, and then as far as it goes while the step waits.
                EXPECT_LE(walk.off_rad(), (0.5 + 1.0 / 16.0) * kStep + walk.speed_rad_s * (longest_s + 0.2))
                    << walk.frame;
            }
            const double period_s = (by_time ? 5.0 : 5.3) + longest_s;
            EXPECT_NEAR(jumps, 400.0 / period_s, 0.06 * 400.0 / period_s + 1.0) << by_time << longest_s;
        }
    }
}

/// Where the camera always moves, nothing differs to the last bit, and where nothing is waited for the camera is not
/// asked.
TEST(StepWait, OfACameraThatMovesIsNoWait)
{
    for (const bool by_time : {false, true}) {
        const StepOptions plain = by_time ? byTime(5.0) : byAngle();
        Walk a;
        Walk b;
        Walk c;
        c.stop = 100000;
        for (; a.frame < 1000; a.pass(), b.pass(), c.pass()) {
            a.next(plain);
            b.next(waiting(plain, 7.0));
            c.next(plain);
            ASSERT_EQ(a.course.steps().earlier_ws, b.course.steps().earlier_ws);
            ASSERT_EQ(a.course.steps().earlier_ws, c.course.steps().earlier_ws);
        }
    }
}

TEST(StepWait, ASunThatJumpsItselfIsFollowedAtOnce)
{
    SunCourse course;
    const StepOptions options = waiting(byAngle(), 1e4);
    course.follow(overhead(0.0), 0.0, Stepping::jump, options, false);
    course.follow(overhead(0.3), 0.1, Stepping::jump, options, false);
    EXPECT_EQ(course.steps().earlier_ws, overhead(0.3));
}

/// Time that stands, goes back or is none at all: a step waits no longer than it should by the time that there is.
TEST(StepWait, BearsAnyTime)
{
    for (const double time_s : {kNan, std::numeric_limits<double>::infinity()}) {
        SunCourse course;
        for (int frame = 0; frame < 100; ++frame)
            course.follow(overhead(0.02 * kStep * frame), time_s, Stepping::jump, waiting(byAngle(), 5.0), false);
        EXPECT_LE(angleBetween(course.steps().earlier_ws, overhead(0.02 * kStep * 99)), 0.6 * kStep);
    }
    SunCourse back;
    for (int frame = 0; frame < 200; ++frame)
        back.follow(overhead(0.02 * kStep * frame), frame < 100 ? 1000.0 : 0.1 * (frame - 100), Stepping::jump,
                    waiting(byAngle(), 5.0), false);
    EXPECT_LE(angleBetween(back.steps().earlier_ws, overhead(0.02 * kStep * 199)), 3.1 * kStep);
}

/// A planner sees by its frames whether the camera moves: by place, direction, field of view, a cut; not by jitter.
TEST(StepWait, APlannerKnowsWhetherTheCameraMoves)
{
    enum class Change : std::uint8_t { none, eye, turn, zoom, cut, size, jitter };
    for (const Change change :
         {Change::none, Change::eye, Change::turn, Change::zoom, Change::cut, Change::size, Change::jitter}) {
        Meadow meadow;
        ShadowOptions options{
            .technique = {Partition::single, Fit::uniform, Filter::hard, Soften::none, Motion::step_jump}};
        options.map_size = 64;
        options.steps = waiting(byAngle(), 1e4);
        Planner planner(options);
        std::set<double> places;
        for (int frame = 0; frame < 60; ++frame) {
            meadow.lights[0].direction_ws = overhead(0.3 + 0.1 * kStep * frame);
            meadow.frame.time_s = 0.1 * frame;
            const bool acts = frame == 40;
            const glm::dvec3 eye(acts && change == Change::eye ? 1.0 : 0.0, 3.0, 10.0);
            const glm::dvec3 target(acts && change == Change::turn ? 1.0 : 0.0, 0.0, 0.0);
            meadow.frame.camera = perspectiveCamera(eye, target, acts && change == Change::zoom ? 0.7 : 0.8);
            meadow.frame.cut = acts && change == Change::cut;
            meadow.frame.size_px = {acts && change == Change::size ? 641U : 640U, 360U};
            if (change == Change::jitter) {
                const glm::dvec2 jitter(0.25 * (frame % 4), -0.5 + 0.3 * (frame % 3));
                Camera& camera = meadow.frame.camera;
                camera.jitter_px = jitter;
                const glm::dmat4 moved(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, jitter.x * 2.0 / 640, jitter.y * 2.0 / 360,
                                       0, 1);
                camera.clip_from_world = moved * camera.clip_from_world;
            }
            places.insert(meadow.plan(planner).lights[0].steps.earlier_ws.x);
        }
        const bool waits_on = change == Change::none || change == Change::jitter;
        EXPECT_EQ(places.size(), waits_on ? 1U : 2U) << static_cast<int>(change);
    }
}

} // namespace
} // namespace gnomon
