// SPDX-License-Identifier: Apache-2.0
// A street of boxes, whose light has partition virtual.
#pragma once

#include "random_scenes.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <algorithm>
#include <vector>

namespace gnomon::test {

inline constexpr Technique kVirtual{Partition::virtual_pages, Fit::uniform, Filter::pcf};

/// A street of boxes on a floor under a sun.
struct Street {
    ObjectSet set;
    std::vector<Light> lights;
    std::vector<ObjectId> boxes;
    ShadowOptions options{.technique = kVirtual};
    std::vector<SeenCell> cells;
    std::vector<PageRequests> requests;
    Frame frame;

    Street()
    {
        set.add({{-200, -1, -200}, {200, 0, 200}});
        Random random(3);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 at = random.inBox({-100, 0, -100}, {100, 0, 100});
            const glm::vec3 low(at);
            boxes.push_back(set.add({low, low + glm::vec3(random.inBox({1, 1, 1}, {4, 9, 4}))}));
        }
        Light sun;
        sun.key = 7;
        sun.direction_ws = glm::normalize(glm::dvec3(0.4, -0.8, 0.3));
        lights.push_back(sun);
        frame.lights = lights;
        frame.objects = &set;
        look({0, 6, 30}, {0, 1, 0});
    }
    void look(const glm::dvec3& eye, const glm::dvec3& target)
    {
        frame.camera = perspectiveCamera(eye, target, 0.9, 16.0 / 9.0);
    }
    /// A light with a place over the street instead of the sun.
    void placeLight(LightType type)
    {
        Light& light = lights[0];
        light.type = type;
        light.position_ws = {2, 14, 3};
        light.direction_ws = glm::normalize(glm::dvec3(-0.2, -0.9, -0.3));
        light.outer_half_angle_rad = 1.0;
        light.radius_m = 0.1;
        frame.lights = lights;
    }
    /// Requests of the floor, as this frame's camera sees it, with an edge around one place.
    void request(const glm::dvec3& edge_ws, double around_m)
    {
        const glm::dmat4 clip = clipFromWorld(frame.camera);
        cells.clear();
        for (double x = -100.0; x <= 100.0; x += 1.0)
            for (double z = -100.0; z <= 30.0; z += 1.0) {
                const glm::dvec3 p(x, 0.0, z);
                const glm::dvec4 h = clip * glm::dvec4(p, 1.0);
                if (!(h.w > 0.1) || std::abs(h.x) > h.w || std::abs(h.y) > h.w)
                    continue;
                const glm::dvec2 place = (glm::dvec2(h) / h.w * 0.5 + 0.5) * glm::dvec2(frame.size_px);
                cells.push_back({glm::vec2(place), static_cast<float>(h.z / h.w),
                                 glm::distance(p, edge_ws) < around_m ? 8.0F : 0.0F});
            }
        requests = {{7, clip, frame.size_px, cells}};
        frame.requests = requests;
    }
    /// The next frame of a walk: another view, perhaps other requests, and three boxes moved.
    void walk(Random& random)
    {
        ++frame.index;
        look(random.inBox({-20, 2, 10}, {20, 12, 40}), random.inBox({-20, 0, -20}, {20, 2, 0}));
        if (random.below(2) == 0)
            request(random.inBox({-20, 0, -20}, {20, 0, 20}), 3.0);
        for (int k = 0; k < 3; ++k) {
            const ObjectId box = boxes[random.below(200)];
            const Aabb at = set.bounds(box);
            const glm::vec3 step(random.inBox({-1, 0, -1}, {1, 0, 1}));
            set.update(box, {at.min + step, at.max + step});
        }
    }
};

inline std::uint64_t drawnTexels(const Plan& plan)
{
    std::uint64_t texels = 0;
    for (const View& view : plan.views)
        texels += texelsToDraw(view);
    return texels;
}

/// The first view that serves a point: the finest one.
inline const View* viewOf(const Plan& plan, const glm::dvec3& p)
{
    const auto found = std::ranges::find_if(plan.views, [&](const View& view) {
        const auto place = placeOnMap(view, p);
        return view.serves.sector.holds(p) && place && std::max(std::abs(place->x), std::abs(place->y)) < 1.0;
    });
    return found != plan.views.end() ? &*found : nullptr;
}

} // namespace gnomon::test
