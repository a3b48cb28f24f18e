// SPDX-License-Identifier: Apache-2.0
// A street under lamps with people in it, that the tests of turns share.
#pragma once

#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace gnomon::test {

/// Lamps along a street with posts, and people who walk it.
struct Avenue {
    ObjectSet set;
    std::vector<ObjectId> walkers;
    std::vector<Light> lights;
    Frame frame;
    ShadowOptions options{.technique = kPlainTechnique, .map_size = 64, .max_layers = 512};

    explicit Avenue(int lamps, Partition partition = Partition::cube, Motion motion = Motion::free)
    {
        for (int z = -40; z < 40; z += 4) {
            set.add({{-8, -0.1F, z}, {8, 0.0F, z + 4}});
            set.add(boxAt({2.0, 1.0, z + 2.0}, {0.2, 1.0, 0.2}));
        }
        for (int i = 0; i < 24; ++i) {
            walkers.push_back(set.add(walkerAt(i, 0), {true, true, true}));
        }
        options.technique.partition = partition;
        options.technique.motion = motion;
        for (int i = 0; i < lamps; ++i) {
            Light& lamp = lights.emplace_back();
            lamp.type = LightType::point;
            lamp.key = static_cast<std::uint32_t>(i);
            lamp.position_ws = {-1.0, 3.0, 36.0 - 72.0 * i / lamps};
            lamp.range_m = 9.0;
        }
        frame.size_px = {640, 400};
        frame.objects = &set;
        frame.lights = lights;
        look(0);
    }
    static Aabb walkerAt(int walker, int step)
    {
        const double z = std::fmod(3.3 * walker + 0.05 * step * (1 + walker % 3), 76.0) - 38.0;
        return boxAt({-3.0 + 0.25 * walker, 0.9, z}, {0.25, 0.9, 0.25});
    }
    void look(double way_m) { frame.camera = perspectiveCamera({0, 2, 42 - way_m}, {0, 1, -way_m}, 0.8); }
    void walk(int step)
    {
        for (int i = 0; i < static_cast<int>(walkers.size()); ++i) {
            set.update(walkers[static_cast<std::size_t>(i)], walkerAt(i, step));
        }
        look(0.05 * step);
        ++frame.index;
    }
};

inline std::uint64_t drawnTexels(const Plan& plan, const LightPlan& light)
{
    std::uint64_t texels = 0;
    for (std::uint32_t i = 0; i < light.view_count; ++i) {
        texels += texelsToDraw(plan.views[light.first_view + i]);
    }
    return texels;
}

inline std::uint64_t drawnTexels(const Plan& plan)
{
    std::uint64_t texels = 0;
    for (const LightPlan& light : plan.lights) {
        texels += drawnTexels(plan, light);
    }
    return texels;
}

inline std::uint32_t longestWait(const Plan& plan)
{
    std::uint32_t longest = 0;
    for (const LightPlan& light : plan.lights) {
        longest = std::max(longest, light.waited);
    }
    return longest;
}

} // namespace gnomon::test
