// SPDX-License-Identifier: Apache-2.0
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

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

} // namespace
} // namespace gnomon
