// SPDX-License-Identifier: Apache-2.0
// From where a scene is looked at that has no camera, and where its sun stands if it has no light.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// From where a scene shows most of itself: obliquely, flat things from higher up, tall ones from lower, long ones from
/// their longer side. Surroundings of its detail do not count. The light comes over the viewer's left shoulder.
[[nodiscard]] Outlook outlookOn(const scene::Scene& scene, const scene::State& state);

/// An orthographic eye so far back from its target that nothing of the scene is behind it.
[[nodiscard]] host::Eye standingBack(const host::Eye& eye, const Aabb& scene_bounds_ws);

/// Unit, the way the light of the sun travels.
[[nodiscard]] glm::dvec3 sunOf(const Outlook& outlook);

} // namespace gnomon::app
