// SPDX-License-Identifier: Apache-2.0
// A ground for models that have none, and which way up a model stands.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// Share of a model, seen from above, that a floor of its own lies under: where the lowest surface that faces up is the
/// lowest surface, or but a thin slab above it. [0, 1]; 0 where there is nothing to see from above. `up` is 1 for y, 2
/// for z.
[[nodiscard]] double flooredShare(const scene::Scene& scene, const scene::State& state, int up);

/// Does it lack a ground to stand on?
[[nodiscard]] bool isBottomless(const scene::Scene& scene, const scene::State& state);

/// Does it lie on its side, as what was made with z up does? To be told, never to be acted on: a relief on a wall looks
/// the same.
[[nodiscard]] bool looksFallen(const scene::Scene& scene, const scene::State& state);

/// Turns a file whose z is up, so that y is: its nodes hang under a new one.
void standUp(scene::Scene& scene);

/// A disc under `model_ws` that fades into the sky. Its node is the scene's last.
void addGround(scene::Scene& scene, const Aabb& model_ws);

} // namespace gnomon::app
