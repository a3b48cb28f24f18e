// SPDX-License-Identifier: Apache-2.0
// How far beside a receiver's own ray of light its rays to the rest of the light lead: what a map has room for when its
// filter follows them (integratesLight()).
#pragma once

#include "light_space.h"

#include <gnomon/object_set.h>

namespace gnomon {

/// As LightRect has it, the farthest that a ray from `far_m` to a point of the light is off the ray to the light's
/// centre where it comes to `near_m`: depths by LightSpace::depth_ws, near before far. 0 for a light without a size.
[[nodiscard]] double lightReach(const Light& light, const LightSpace& space, double near_m, double far_m);

/// The same, but no more than a map can spare that shows `size`: its texels grow by half at most.
[[nodiscard]] double affordableReach(double reach, const glm::dvec2& size);

/// The reach for a map that holds still: a bound for every receiver in the scene, in steps.
[[nodiscard]] double steadyReach(const Light& light, const LightSpace& space, const Aabb& scene_ws);

/// Filter pcss takes no wider lights: the few texels of its discs miss what is close to the receiver, and no mean depth
/// stands for what is near and far. A sun's limit is its diameter, a little above 25 degrees for what rounding adds; a
/// lamp's is its radius over the distance of the farthest receiver: 11 degrees across there.
constexpr double kWidestPcssSun_rad = 0.43634;
constexpr double kWidestPcssLamp = 0.1;
inline constexpr Outcome kTooWideSun{
    OutcomeKind::refused, "pcss takes suns up to 25 degrees across: beyond, what is near and far has no mean depth; "
                          "filter raymarch takes any"};
inline constexpr Outcome kTooWideLamp{
    OutcomeKind::refused, "pcss takes lamps whose radius is at most a tenth of their distance to the farthest "
                          "receiver: beyond, what is near and far has no mean depth; filter raymarch takes any"};

/// One of these two, or ok. All receivers in a lamp's range count, in sight or not: no shadow goes as the camera turns.
[[nodiscard]] Outcome widthForPcss(const Light& light, const ObjectSet& objects);

/// How far the rays of a light lead, and no farther than the scene.
[[nodiscard]] Aabb reachBox(const Light& light, const Aabb& scene_ws);

} // namespace gnomon
