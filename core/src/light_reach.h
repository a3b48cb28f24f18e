// SPDX-License-Identifier: Apache-2.0
// How far beside a receiver's own ray of light its rays to the rest of the light lead: what a map has room for when its
// filter follows them (integratesLight()).
#pragma once

#include "light_space.h"

namespace gnomon {

/// As LightRect has it, the farthest that a ray from `far_m` to a point of the light is off the ray to the light's
/// centre where it comes to `near_m`: depths by LightSpace::depth_ws, near before far. 0 for a light without a size.
[[nodiscard]] double lightReach(const Light& light, const LightSpace& space, double near_m, double far_m);

/// The same, but no more than a map can spare that shows `size`: its texels grow by half at most.
[[nodiscard]] double affordableReach(double reach, const glm::dvec2& size);

/// Of a map that holds still: what no receiver in the scene exceeds, in steps.
[[nodiscard]] double steadyReach(const Light& light, const LightSpace& space, const Aabb& scene_ws);

/// How far the rays of a light lead, and no farther than the scene.
[[nodiscard]] Aabb reachBox(const Light& light, const Aabb& scene_ws);

} // namespace gnomon
