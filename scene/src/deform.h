// SPDX-License-Identifier: Apache-2.0
// Morph targets and skins on the CPU.
#pragma once

#include "scene/state.h"

#include <span>

namespace gnomon::scene {

[[nodiscard]] bool deforms(const Node& node, const Primitive& primitive);

/// Gives `deformed` the vectors that `primitive` needs; the only place that allocates.
void prepareDeformed(const Primitive& primitive, DeformedPrimitive& deformed);

/// Morphs and, with `joint_matrices` (world_from_mesh, one per joint), skins `primitive` into `deformed`, whose
/// vectors prepareDeformed has sized. Returns the box of the new positions. Missing weights count as zero.
Aabb deform(const Primitive& primitive, std::span<const float> morph_weights, std::span<const glm::mat4> joint_matrices,
            DeformedPrimitive& deformed);

} // namespace gnomon::scene
