// SPDX-License-Identifier: Apache-2.0
// The library, set up for one technique.
#pragma once

#include "forward_shadows.h"
#include "mask_tiles.h"
#include "scene_data.h"
#include "volume_meshes.h"

#include "host/frame_renderer.h"

#include <gnomon/draw_rate.h>
#include <gnomon/vulkan/classics.h>

#include <optional>

namespace gnomon::host {

/// Frames that the GPU has not finished share one, so it lives until the last of them is done.
struct Shadows {
    /// `profiler` is told of draws of classic techniques, and lives longer. Throws Error.
    Shadows(SceneData& scene, const RenderOptions& options, vulkan::Profiler& profiler);
    Shadows(const Shadows&) = delete; // callbacks point to it
    Shadows& operator=(const Shadows&) = delete;

    /// The last plan again for this frame's eye; its maps must not be drawn.
    [[nodiscard]] const Plan& planAgain(const Frame& frame);
    /// The last plan as the GPU has fitted it. The GPU has finished it, with this slot.
    [[nodiscard]] const Plan& fittedPlan(std::uint32_t slot);

    GBufferShape reads; // the images of surfaces that the mask reads
    Planner planner;
    vulkan::ShadowRenderer renderer;
    vulkan::CasterDrawer casters;
    std::optional<MaskTiles> tiles;              // for a compact mask
    std::optional<ForwardShadows> forward;       // for filters with maps
    std::optional<VolumeMeshes> volume_meshes;   // for filters volumes and smoothies
    std::optional<vulkan::VolumeDrawer> volumes; // for filter volumes
    std::optional<vulkan::FinDrawer> fins;       // for filter smoothies
    const Plan* plan = nullptr;                  // the last one
    DrawRate draw_rate;                          // with ShadowOptions::draw_budget_ms
    bool warm = false;                           // a frame was measured, whose time was that of compiling, too

private:
    Plan kept_;
    Plan fitted_;
    std::optional<std::uint64_t> fitted_frame_;
};

} // namespace gnomon::host
