// SPDX-License-Identifier: Apache-2.0
// The cost of the floats of a view, as docs/c.md has it: points far from the world's origin are taken to a map as a
// shader would, in single precision.
#include <gnomon/gnomon.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <random>

namespace gnomon::test {
namespace {

/// The largest distances of a point's place from that in double precision, texels.
struct Errors {
    double world = 0.0;
    double eye = 0.0;
};

double texelsApart(const glm::vec4& rounded, const glm::dvec4& exact, double texels)
{
    const glm::dvec2 apart = glm::dvec2(rounded) / static_cast<double>(rounded.w) - glm::dvec2(exact) / exact.w;
    return 0.5 * texels * std::max(std::abs(apart.x), std::abs(apart.y));
}

Errors errorsOf(const GnomonView& view, const glm::dvec3& eye_ws)
{
    const glm::dmat4 exact = glm::make_mat4(view.clip_from_world);
    const glm::mat4 from_world = glm::make_mat4(view.clip_from_world_f);
    const glm::mat4 from_eye = glm::make_mat4(view.clip_from_eye_f);
    std::mt19937 numbers(3);
    std::uniform_real_distribution<double> around(-20.0, 20.0);
    Errors errors;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 from_the_eye(around(numbers), around(numbers), around(numbers));
        const glm::dvec4 place = exact * glm::dvec4(eye_ws + from_the_eye, 1.0);
        const double texels = view.tile_width;
        errors.world = std::max(
            errors.world, texelsApart(from_world * glm::vec4(glm::vec3(eye_ws + from_the_eye), 1.0F), place, texels));
        errors.eye =
            std::max(errors.eye, texelsApart(from_eye * glm::vec4(glm::vec3(from_the_eye), 1.0F), place, texels));
    }
    return errors;
}

/// A sun's map of 2048 texels over a ground of 50 m, so far from the origin along x and z.
Errors errorsAt(double distance_m)
{
    GnomonObjects* objects = gnomonMakeObjects(GNOMON_INTERFACE);
    GnomonPlanner* planner = gnomonMakePlanner(GNOMON_INTERFACE);
    const auto at = static_cast<float>(distance_m / std::sqrt(2.0));
    const GnomonBounds ground{{at - 25.0F, -0.1F, at - 25.0F}, {at + 25.0F, 0.0F, at + 25.0F}};
    GnomonObjectId id;
    gnomonAddObject(objects, &ground, nullptr, &id);
    gnomonSetOption(planner, 0, "partition", "single");
    gnomonSetOption(planner, 0, "fit", "scene");
    gnomonSetOption(planner, 0, "filter", "pcf");
    gnomonSetOption(planner, 0, "map-size", "2048");
    GnomonLight sun;
    GnomonFrame frame;
    gnomonInitLight(&sun, sizeof(sun));
    gnomonInitFrame(&frame, sizeof(frame));
    sun.direction_ws[0] = 0.48;
    sun.direction_ws[1] = -0.8;
    sun.direction_ws[2] = 0.36;
    const glm::dvec3 eye_ws(at, 10.0, at);
    const glm::dmat4 clip_from_world =
        glm::perspectiveRH_ZO(1.0, 1.0, 1000.0, 0.1) *
        glm::lookAtRH(eye_ws, eye_ws + glm::dvec3(0.1, -1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
    std::memcpy(frame.camera.clip_from_world, glm::value_ptr(clip_from_world), sizeof(clip_from_world));
    std::memcpy(frame.camera.eye_ws, glm::value_ptr(eye_ws), sizeof(eye_ws));
    frame.objects = objects;
    frame.lights = &sun;
    frame.light_count = 1;
    const GnomonPlan* plan = gnomonPlan(planner, &frame);
    Errors errors;
    EXPECT_NE(plan, nullptr) << gnomonLastError()->message;
    if (plan != nullptr && plan->view_count == 1) {
        errors = errorsOf(*gnomonViewAt(planner, 0), eye_ws);
    } else {
        ADD_FAILURE() << gnomonLightAt(planner, 0)->reason;
    }
    gnomonFreePlanner(planner);
    gnomonFreeObjects(objects);
    return errors;
}

TEST(CPrecision, FloatsRelativeToTheEyeDoNotLoseByDistance)
{
    for (const double distance_m : {0.0, 1e3, 1e5}) {
        const Errors errors = errorsAt(distance_m);
        std::printf("%g m from the origin: %.4f texels in the world, %.4f from the eye\n", distance_m, errors.world,
                    errors.eye);
        EXPECT_LT(errors.eye, 0.001);
        EXPECT_LT(errors.world, 0.001 + distance_m * 2e-5);
        EXPECT_GT(errors.world, distance_m * 2e-6);
    }
}

} // namespace
} // namespace gnomon::test
