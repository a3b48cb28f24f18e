// SPDX-License-Identifier: Apache-2.0
// A scene with one of everything that the renderer treats in its own way.
#pragma once

#include "host/frame_renderer.h"
#include "scene/model.h"

namespace gnomon::host::test {

// Nodes of the scene, by what they are.
enum : std::uint32_t { kGroundNode, kMoverNode, kMaskedNode, kGlassNode, kGlowNode, kJointNode, kFlagNode, kShyNode };

/// Adds a node that shows it alone.
void addMesh(scene::Scene& scene, scene::Primitive primitive);

/// A ground, a box that moves along x with time, a masked fence, a pane of glass, a glowing box, a flag whose one joint
/// moves, and a box that receives no shadow; a sun and a spot light with a cookie.
[[nodiscard]] scene::Scene smallScene();
[[nodiscard]] Eye smallEye();

/// How many values differ by more than this share of the other's largest.
[[nodiscard]] std::size_t differing(const ImageF& a, const ImageF& b, float share);

} // namespace gnomon::host::test
