// SPDX-License-Identifier: Apache-2.0
// A map made once around all of the scene: where its light stands, what it shows and between which depths.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 4 and eq. 6.
#pragma once

#include "light_space.h"

namespace gnomon {

/// The rectangle of a box across a parallel light, and a little more for rounding.
[[nodiscard]] LightRect rectOfScene(const LightSpace& space, const Aabb& scene_ws);

struct SceneDepths {
    double near_m = 0.0; // as LightSpace::depth_ws measures it, from its origin
    double far_m = 1.0;
};
/// Between them lies all of the box; they are `least_m` apart at least, and more than rounding.
[[nodiscard]] SceneDepths depthsOfScene(const LightSpace& space, const Aabb& scene_ws, double least_m);

/// Eq. 6: the centre of the box's corners, backed out against the light to a depth of `near_m`.
[[nodiscard]] glm::dvec3 lightPlaceOfScene(const LightSpace& space, const Aabb& scene_ws, double near_m);

} // namespace gnomon
