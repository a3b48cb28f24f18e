// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/state.h"

namespace gnomon::host {

/// Does an object fade into the sky (ShadingModel::horizon)? The size of such a ground does not depend on the model on
/// it.
[[nodiscard]] bool fades(const scene::Scene& scene, const scene::Object& object);
/// Bounds of all objects that do not fade.
[[nodiscard]] Aabb modelBounds(const scene::Scene& scene, const scene::State& state);

} // namespace gnomon::host
