// SPDX-License-Identifier: Apache-2.0
// Where the eye stands in a scene without a camera, and the sun in a scene without a light.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// The outlook that shows most of a scene: obliquely, flat things from higher up, tall ones from lower, long ones from
/// their longer side. Surroundings of its detail do not count. The light comes over the viewer's left shoulder.
[[nodiscard]] Outlook outlookOn(const scene::Scene& scene, const scene::State& state);

/// An orthographic eye so far back from its target that nothing of the scene is behind it.
[[nodiscard]] host::Eye standingBack(const host::Eye& eye, const Aabb& scene_bounds_ws);

/// The direction in which the sun's light travels, unit.
[[nodiscard]] glm::dvec3 sunOf(const Outlook& outlook);

} // namespace gnomon::app
