// SPDX-License-Identifier: Apache-2.0
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon {
namespace {

TEST(Camera, AWrongReversedZIsFoundOutFromTheMatrix)
{
    test::Random random(31);
    int degenerate = 0;
    for (int i = 0; i < 400; ++i) {
        ObjectSet set;
        set.add({{-10, 0, -10}, {10, 0, 10}}, {false, true, false});
        set.add({{-1, 1, -1}, {1, 3, 1}});
        const std::vector<Light> lights{test::sun({0, -1, 0})};
        Frame frame;
        frame.objects = &set;
        frame.lights = lights;
        Planner planner(ShadowOptions{.technique = kPlainTechnique});
        const glm::dvec3 away = i % 4 == 0 ? random.inBox(glm::dvec3(-5e4), glm::dvec3(5e4)) : glm::dvec3(0.0);
        const glm::dvec3 eye = away + random.inBox({-40, 5, -40}, {40, 60, 40});
        const double near_m = random.uniform(0.05, 2.0);
        Camera& camera = frame.camera;
        camera = i % 3 == 0   ? test::endlessCamera(eye, away, 1.0, 1.6, near_m)
                 : i % 3 == 1 ? test::perspectiveCamera(eye, away, 1.0, 1.6, near_m, near_m + random.uniform(1, 900))
                              : test::orthographicCamera(eye, away, 20.0);
        if (i % 2 == 1) { // the other way round: z becomes w - z
            for (int column = 0; column < 4; ++column)
                camera.clip_from_world[column][2] =
                    camera.clip_from_world[column][3] - camera.clip_from_world[column][2];
            camera.reversed_z = !camera.reversed_z;
        }
        if (i % 5 == 0) // as an engine of floats has it
            camera.clip_from_world = glm::dmat4(glm::mat4(camera.clip_from_world));
        EXPECT_NE(planner.plan(frame).lights[0].outcome.kind, OutcomeKind::degenerate) << i;
        camera.reversed_z = !camera.reversed_z;
        const Outcome outcome = planner.plan(frame).lights[0].outcome;
        const bool found = outcome.kind == OutcomeKind::degenerate;
        degenerate += found ? 1 : 0;
        if (found) {
            EXPECT_NE(outcome.reason.find("reversed_z"), std::string_view::npos) << outcome.reason;
        }
    }
    EXPECT_GT(degenerate, 350); // of what a float far from the origin leaves of a near plane nothing can be told
}

// As OpenGL's matrices have it: z from -w to w where these have 0 to w.
Camera withOpenGlDepth(Camera camera)
{
    for (int column = 0; column < 4; ++column) {
        camera.clip_from_world[column][2] = 2.0 * camera.clip_from_world[column][2] - camera.clip_from_world[column][3];
    }
    camera.clip_depth = ClipDepth::minus_one_to_one;
    return camera;
}

TEST(Camera, OfOpenGlSeesWhatItSees)
{
    test::Random random(32);
    for (int i = 0; i < 200; ++i) {
        ObjectSet set;
        set.add({{-10, 0, -10}, {10, 0, 10}}, {false, true, false});
        for (int box = 0; box < 20; ++box)
            set.add(test::boxAt(random.inBox({-9, 1, -9}, {9, 1, 9}), glm::dvec3(0.5)));
        const std::vector<Light> lights{test::sun({0.3, -1, 0.1}), test::spot({4, 9, 3}, {0, -1, 0}, 0.7)};
        const glm::dvec3 eye = random.inBox({-20, 1, -20}, {20, 20, 20});
        const double near_m = random.uniform(0.05, 9.0);
        Camera plain = i % 3 == 0   ? test::endlessCamera(eye, {}, 1.0, 1.6, near_m)
                       : i % 3 == 1 ? test::perspectiveCamera(eye, {}, 1.0, 1.6, near_m, near_m + 30.0)
                                    : test::orthographicCamera(eye, {}, 20.0);
        if (i % 2 == 1) { // depth as OpenGL has it mostly: the near plane first
            for (int column = 0; column < 4; ++column)
                plain.clip_from_world[column][2] = plain.clip_from_world[column][3] - plain.clip_from_world[column][2];
            plain.reversed_z = !plain.reversed_z;
        }
        const Motion motion = i % 5 == 0 ? Motion::snap : Motion::free;
        const ShadowOptions options{.technique = {i % 4 == 0 ? Partition::cascades : Partition::single, Fit::lispsm,
                                                  Filter::hard, Soften::none, motion}};
        std::array<Plan, 2> made;
        for (const bool open_gl : {false, true}) {
            Frame frame;
            frame.objects = &set;
            frame.lights = lights;
            frame.camera = open_gl ? withOpenGlDepth(plain) : plain;
            Planner planner(options);
            made[open_gl ? 1 : 0] = planner.plan(frame);
        }
        ASSERT_EQ(made[0].receivers, made[1].receivers) << i;
        ASSERT_EQ(made[0].views.size(), made[1].views.size()) << i;
        for (std::size_t view = 0; view < made[0].views.size(); ++view)
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    EXPECT_NEAR(made[0].views[view].projection.clip_from_world[column][row],
                                made[1].views[view].projection.clip_from_world[column][row], 1e-6)
                        << i;
    }
}

// Nothing but the host can tell: taken for what it is not, the matrix is of a camera whose near plane is farther away,
// nearly twice as far, and what stands before that is not seen.
TEST(Camera, OfOpenGlThatDoesNotSaySoLosesWhatIsNear)
{
    ObjectSet set;
    const ObjectId near_one = set.add(test::boxAt({0, 1, 7.3}, glm::dvec3(0.2))); // 1.5 to 1.9 m before the eye
    set.add({{-30, 0, -30}, {30, 0, 30}});
    const std::vector<Light> lights{test::sun({0.3, -1, 0.1})};
    Frame frame;
    frame.objects = &set;
    frame.lights = lights;
    frame.camera = withOpenGlDepth(test::perspectiveCamera({0, 1, 9}, {0, 1, 0}, 1.0, 1.6, 1.0, 100.0));
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    const auto sees = [&] {
        const auto& receivers = planner.plan(frame).receivers;
        return std::find(receivers.begin(), receivers.end(), near_one.index) != receivers.end();
    };
    EXPECT_TRUE(sees());
    frame.camera.clip_depth = ClipDepth::zero_to_one;
    EXPECT_TRUE(sees()); // reversed, it is the far end that is cut
    frame.camera = withOpenGlDepth(test::perspectiveCamera({0, 1, 9}, {0, 1, 0}, 1.0, 1.6, 1.0, 100.0));
    for (int column = 0; column < 4; ++column)
        frame.camera.clip_from_world[column][2] *= -1.0; // the near plane first, as OpenGL has it
    frame.camera.reversed_z = false;
    EXPECT_TRUE(sees());
    frame.camera.clip_depth = ClipDepth::zero_to_one;
    EXPECT_FALSE(sees()); // the near plane is at 1.98 m
}

TEST(Camera, StandsWhereNothingButJitterMovesIt)
{
    const Camera camera = test::perspectiveCamera({3, 4, 50}, {0, 0, 0}, 0.8);
    const glm::uvec2 size(640, 360);
    EXPECT_TRUE(sameSight(camera, camera, size));
    Camera moved = test::perspectiveCamera({3, 4, 50.0001}, {0, 0, 0}, 0.8);
    EXPECT_FALSE(sameSight(camera, moved, size));
    EXPECT_FALSE(sameSight(camera, test::perspectiveCamera({3, 4, 50}, {0.001, 0, 0}, 0.8), size));
    EXPECT_FALSE(sameSight(camera, withOpenGlDepth(camera), size));
    moved = camera;
    moved.jitter_px = {0.4, -0.3};
    EXPECT_FALSE(sameSight(camera, moved, size)) << "it says so but was not moved";
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 2; ++row)
            moved.clip_from_world[column][row] +=
                camera.clip_from_world[column][3] * moved.jitter_px[row] * 2.0 / size[row];
    EXPECT_TRUE(sameSight(camera, moved, size));
}

} // namespace
} // namespace gnomon
