// SPDX-License-Identifier: Apache-2.0
// A floor under lamps, that the tests of partition multi share.
#pragma once

#include "worlds.h"

#include <gnomon/planner.h>

#include <vector>

namespace gnomon::test {

/// A floor of tiles, 40 m on a side, with posts on it.
struct Hall {
    ObjectSet set;
    std::vector<Light> lights;
    Frame frame;
    ShadowOptions options{.technique = kPlainTechnique};

    Hall()
    {
        for (int z = -20; z < 20; z += 2) {
            for (int x = -20; x < 20; x += 2) {
                set.add({{x, -0.1F, z}, {x + 2, 0.0F, z + 2}});
            }
        }
        for (int z = -18; z <= 18; z += 6) {
            for (int x = -18; x <= 18; x += 6) {
                set.add(boxAt({x, 1.0, z}, {0.2, 1.0, 0.2}));
            }
        }
        options.technique.partition = Partition::multi;
        frame.objects = &set;
        frame.size_px = {640, 400};
    }
    void addLamp(const glm::dvec3& at, double range_m)
    {
        Light lamp;
        lamp.type = LightType::point;
        lamp.position_ws = at;
        lamp.range_m = range_m;
        lamp.key = static_cast<std::uint32_t>(lights.size());
        lights.push_back(lamp);
        frame.lights = lights;
    }
    void look(const glm::dvec3& eye, const glm::dvec3& target) { frame.camera = perspectiveCamera(eye, target, 0.8); }
};

} // namespace gnomon::test
