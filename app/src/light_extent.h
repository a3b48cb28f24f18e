// SPDX-License-Identifier: Apache-2.0
// How the emitting sphere of a lamp lies in a scene.
#pragma once

#include "scene/state.h"

#include <glm/vec3.hpp>

namespace gnomon::app {

/// Whether a surface comes nearer to `centre_ws` than `radius_m`. Blended surfaces do not count: the ray tracer does
/// not know them. Looks at every triangle of the objects whose bounds the sphere meets.
[[nodiscard]] bool holdsSurface(const scene::Scene& scene, const scene::State& state, const glm::dvec3& centre_ws,
                                double radius_m);

} // namespace gnomon::app
