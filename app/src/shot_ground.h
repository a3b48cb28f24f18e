// SPDX-License-Identifier: Apache-2.0
// A ground for models that have none, and the way up of a model.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// The share of a model, seen from above, with a floor of its own: where the lowest surface that faces up is the lowest
/// surface, or only a thin slab above it. [0, 1]; 0 where there is nothing to see from above. `up` is 1 for y, 2 for z.
[[nodiscard]] double flooredShare(const scene::Scene& scene, const scene::State& state, int up);

/// Does it lack a ground to stand on?
[[nodiscard]] bool isBottomless(const scene::Scene& scene, const scene::State& state);

/// Does it lie on its side, as a model made with z up does? Use it only for a notice: a relief on a wall looks the
/// same.
[[nodiscard]] bool looksFallen(const scene::Scene& scene, const scene::State& state);

/// Turns a file with z up to y up: its nodes become children of a new one.
void standUp(scene::Scene& scene);

/// A disc under `model_ws` that fades into the sky. Its node is the scene's last.
void addGround(scene::Scene& scene, const Aabb& model_ws);

} // namespace gnomon::app
