// SPDX-License-Identifier: Apache-2.0
// Depths as an lvsm map's layers measure them, and back to metres.
#pragma once

#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <span>

namespace gnomon::app {

/// The depth that a view stores for a point in front of its light, [0, 1].
[[nodiscard]] double storedDepth(const View& view, const MomentOptions& options, const glm::dvec3& point_ws);
/// Metres of a stored depth in [0, 1]: along the light's axis from the light itself (spot); along the ray of light,
/// from the plane through ViewProjection::light_place_ws that lies across it or, with level depth, leans with the
/// receivers (directional).
[[nodiscard]] double metresOf(const View& view, const MomentOptions& options, double stored);
/// The layer that a receiver at this depth reads. Precondition: at least one layer, the first of which begins at 0.
[[nodiscard]] std::size_t layerOf(std::span<const pack::DepthLayer> layers, double stored);

} // namespace gnomon::app
