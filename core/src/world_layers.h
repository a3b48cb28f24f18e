// SPDX-License-Identifier: Apache-2.0
// Layers of the world as one view's depths have them.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, eq. 5.
#pragma once

#include "light_space.h"

namespace gnomon {

/// Gradient of depth by which layers of height are layers of depth: level planes are level in depth, which still grows
/// by a metre per metre along the ray. It is the light's own for a light less than ten degrees over (or under) the
/// horizon, or one with a place.
[[nodiscard]] glm::dvec3 heightDepth(const LightSpace& space);

/// Fills in ViewServes::layers of a view whose metric is known. Where layers of height cannot be had, see
/// heightDepth(), they are equal parts of the view's depths.
void placeLayers(std::span<const WorldLayer> layers, LayerAxis axis, const glm::dvec3& forward_ws, View& view);

} // namespace gnomon
