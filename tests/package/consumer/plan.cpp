// SPDX-License-Identifier: Apache-2.0
// Plans a frame, and catches what the library throws: by the library and glm alone.
#include <gnomon/error.h>
#include <gnomon/planner.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cstdio>

int main()
{
    gnomon::ObjectSet objects;
    objects.add({{-20.0F, -0.1F, -20.0F}, {20.0F, 0.0F, 20.0F}});
    objects.add({{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}});
    gnomon::Light sun;
    sun.direction_ws = glm::normalize(glm::dvec3(0.5, -1.0, 0.3));
    glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.8, 1.5, 100.0, 0.1);
    clip_from_view[1][1] = -clip_from_view[1][1];
    const glm::dvec3 eye(3.0, 9.0, 11.0);

    gnomon::Frame frame;
    frame.camera = {eye, clip_from_view * glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0, 1, 0))};
    frame.size_px = {600, 400};
    frame.lights = {&sun, 1};
    frame.objects = &objects;
    gnomon::Planner planner(gnomon::ShadowOptions{});
    if (planner.plan(frame).views.empty()) {
        std::puts("the plan has no view");
        return 1;
    }

    gnomon::ShadowOptions refused;
    refused.technique = gnomon::kPlainTechnique;
    refused.technique.partition = gnomon::Partition::sdsm;
    refused.technique.motion = gnomon::Motion::snap;
    try {
        static_cast<void>(gnomon::resolvedOrThrow(refused));
    } catch (const gnomon::Error& error) {
        std::printf("planned; refused: %s\n", error.what());
        return 0;
    }
    std::puts("sdsm with snap was not refused");
    return 1;
}
