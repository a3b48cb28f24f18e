// SPDX-License-Identifier: Apache-2.0
// Random scenes, cameras and lights for the properties of every plan; awkward ones come often.
#pragma once

#include "worlds.h"

#include <gnomon/planner.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::test {

/// Ways in which a scene is awkward; it may have several.
enum class Awkward : std::uint8_t {
    camera_along_light, // looks the way one of the lights shines
    camera_into_light,  // or against it
    camera_at_lamp,     // along the light, from where it comes
    camera_in_caster,   // the eye is inside a box that casts
    no_size,            // all objects are one point
    far_lamp,           // farther from the scene than a thousand times its size
    least_view,         // field of view of 1 degree
    widest_view,        // field of view of 170 degrees
    no_far_plane,
    orthographic,
    sun_overhead, // or straight from below
    far_origin,   // the scene is far from the world's origin
};
inline constexpr int kAwkwardCount = 12;
[[nodiscard]] std::string_view nameOf(Awkward kind);

struct RandomScene {
    ObjectSet set;
    Camera camera;
    std::vector<Light> lights; // the sun, a lamp among the objects, a lamp away from them; with cube all are points
    ShadowOptions options{.technique = kPlainTechnique};
    double size_m = 1.0;
    std::uint32_t awkward = 0; // bit i: Awkward i

    [[nodiscard]] bool is(Awkward kind) const { return (awkward >> static_cast<int>(kind) & 1U) != 0; }
    [[nodiscard]] Frame frame() const;
};

/// The same scene for the same numbers, on every machine.
[[nodiscard]] RandomScene randomScene(std::uint64_t seed, const Technique& technique);

} // namespace gnomon::test
