// SPDX-License-Identifier: Apache-2.0
// The layers of depth of lvsm maps, as their buffer has them.
// Based on: A. Lauritzen, M. McCool, "Layered Variance Shadow Maps", Graphics Interface 2008.
#pragma once

#include <gnomon/export.h>
#include <gnomon/moment_options.h>
#include <gnomon/plan.h>

#include <gnomon/shared/gpu_structs.h>

#include <vector>

namespace gnomon::pack {

/// One layer of depth of an lvsm map, in the depths that the map stores: the view's depth metric, or with
/// DepthMetricKind::z_over_w a perspective projection's depth.
struct DepthLayer {
    float near = 0.0F;   // where it begins, overlaps included: d'' = (d' - near) / (far - near)
    float far = 1.0F;    // where it ends, overlaps included
    float begins = 0.0F; // it serves receivers from here to where the next layer begins
};
/// The layers of every view where they depend neither on the casters nor on the view (uniform, by hand); else empty.
[[nodiscard]] GNOMON_API std::vector<DepthLayer> fixedDepthLayers(const MomentOptions& options);
/// The GPU's layers in readable form, nearest first.
[[nodiscard]] GNOMON_API std::vector<DepthLayer> describeLayers(const shared::GpuDepthLayers& layers,
                                                                const MomentOptions& options);

/// LayerPlacement::world: the layers of ViewServes::layers, which change with the view's depths. They stay the same as
/// long as the view's map is not drawn again.
[[nodiscard]] GNOMON_API shared::GpuDepthLayers worldDepthLayers(const View& view, const MomentOptions& options);

/// The first contents of a buffer of layers. Layers that depend on the casters start from these.
[[nodiscard]] GNOMON_API shared::GpuDepthLayers firstDepthLayers(const MomentOptions& options);
/// Where in the buffer the layers of the plan's view `view` are. A map keeps its place as long as it has its name,
/// whether or not a plan has a view for it.
[[nodiscard]] GNOMON_API std::uint32_t depthLayersSlot(const Plan& plan, std::uint32_t view);
/// How many places such a plan needs: 1 at least.
[[nodiscard]] GNOMON_API std::uint32_t depthLayersCount(const Plan& plan);

} // namespace gnomon::pack
