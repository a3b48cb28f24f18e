// SPDX-License-Identifier: Apache-2.0
// Classic techniques for a ShadowRenderer: filters id, depth-id, smoothies and volumes, soften smoothies, partition
// paraboloid, midpoint depths (CasterFaces::midpoint) and motion step-alternate. They are a library of their own,
// gnomon::vulkan_classics, which few hosts want.
#pragma once

#include <gnomon/export.h>
#include <gnomon/vulkan/fin_drawer.h>
#include <gnomon/vulkan/shadow_renderer.h>
#include <gnomon/vulkan/volume_drawer.h>

#include <memory>

namespace gnomon::vulkan {

/// The host's callbacks for techniques that draw more than casters.
struct ClassicCallbacks {
    /// Draws fins of filter smoothies; FinDrawer is such a callback. Null: prepare() refuses lights with this filter.
    DrawFins fins;
    /// Draws shadow volumes; VolumeDrawer is such a callback. Null: prepare() refuses lights with filter volumes.
    DrawVolumes volumes;
};

/// For ShadowRendererOptions::classics. Several renderers may share it. A callback of casters then has to look at
/// MapPass::classic; CasterDrawer does.
[[nodiscard]] GNOMON_API std::shared_ptr<const Classics> makeClassics(ClassicCallbacks callbacks = {});

} // namespace gnomon::vulkan
