// SPDX-License-Identifier: Apache-2.0
// What there is to do for a plan, in order. The Vulkan backend executes this list; another API's would, too.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <vector>

namespace gnomon::pack {

/// What is to be done.
enum class FramePassKind : std::uint8_t {
    bounds,  // fit views with ViewProjection::gpu_cascade to the camera's depth: cascade_lights.h
    maps,    // draw the maps of `options`, if there are any; of a filterable filter also make moments, blur, mip levels
    mask,    // listMaskDraws(), those of lights that halvesMask() to an image of half the size
    spread,  // of these lights: from that image over the mask, and what it leaves drawn as listMaskDraws() says
    volumes, // listVolumeDraws(): into the mask, the lights of filter volumes
    history, // join the mask with that of the frame before: lights whose positions take turns (SunSteps::alternate)
    converge, // join it with the mean of all frames before (LightPlan::sample)
    blur,     // listSoftenDraws()
};

/// One thing to do.
struct FramePass {
    FramePassKind kind = FramePassKind::mask; // what
    std::uint32_t options = 0;                // of Plan::options; for maps
};

/// Keeps what `out` has allocated.
GNOMON_API void listFramePasses(const Plan& plan, std::vector<FramePass>& out);
/// Is there a pass of this kind?
[[nodiscard]] GNOMON_API bool has(const std::vector<FramePass>& passes, FramePassKind kind);
/// Has the plan a light of these options? Where it has no light at all, the first options stand in, so that there is
/// something to bind.
[[nodiscard]] GNOMON_API bool hasLights(const Plan& plan, std::uint32_t options);
/// Does the light's plan join this frame's visibility with that of the frame before?
[[nodiscard]] GNOMON_API bool takesTurns(const LightPlan& light);
/// Is the light read at one pixel of each 2 x 2 (MaskSize::half)?
[[nodiscard]] GNOMON_API bool halvesMask(const Plan& plan, const LightPlan& light);
/// Is its visibility a mean over frames?
[[nodiscard]] GNOMON_API bool joinsFrames(const LightPlan& light);

} // namespace gnomon::pack
