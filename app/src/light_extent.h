// SPDX-License-Identifier: Apache-2.0
// The place of a lamp's emitting sphere in a scene.
#pragma once

#include "scene/state.h"

#include <glm/vec3.hpp>

namespace gnomon::app {

/// Whether a surface comes nearer to `centre_ws` than `radius_m`. Blended surfaces do not count. Looks at every
/// triangle of the objects whose bounds the sphere meets.
[[nodiscard]] bool holdsSurface(const scene::Scene& scene, const scene::State& state, const glm::dvec3& centre_ws,
                                double radius_m);

} // namespace gnomon::app
