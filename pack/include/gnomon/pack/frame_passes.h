// SPDX-License-Identifier: Apache-2.0
// The passes that a plan needs, in order. The Vulkan backend executes this list; a backend of another API can too.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <vector>

namespace gnomon::pack {

/// The kind of a pass.
enum class FramePassKind : std::uint8_t {
    bounds,   // fit views with ViewProjection::gpu_cascade to the camera's depth: cascade_lights.h
    maps,     // draw the maps of `options`, if there are any; for a filterable filter also make moments, blur, mip
              // levels
    mask,     // listMaskDraws(); draws of lights with halvesMask() go to an image of half the size
    spread,   // for these lights: spread that image over the mask, then draw the remaining pixels by listMaskDraws()
    volumes,  // listVolumeDraws(): draw the lights of filter volumes into the mask
    history,  // join the mask with that of the frame before: lights whose positions take turns (SunSteps::alternate)
    converge, // join the mask with the mean of all frames before (LightPlan::sample)
    blur,     // listSoftenDraws()
};

/// One pass.
struct FramePass {
    FramePassKind kind = FramePassKind::mask; // the kind of pass
    std::uint32_t options = 0;                // index into Plan::options; for maps
};

/// Lists the passes of a plan. Keeps the memory of `out`.
GNOMON_API void listFramePasses(const Plan& plan, std::vector<FramePass>& out);
/// Is there a pass of this kind?
[[nodiscard]] GNOMON_API bool has(const std::vector<FramePass>& passes, FramePassKind kind);
/// Has the plan a light with these options? In a plan without lights true for the first options, so that there is
/// something to bind.
[[nodiscard]] GNOMON_API bool hasLights(const Plan& plan, std::uint32_t options);
/// Does the light's plan join this frame's visibility with that of the frame before?
[[nodiscard]] GNOMON_API bool takesTurns(const LightPlan& light);
/// Is the light read at one pixel of each 2 x 2 (MaskSize::half)?
[[nodiscard]] GNOMON_API bool halvesMask(const Plan& plan, const LightPlan& light);
/// Is its visibility a mean over frames?
[[nodiscard]] GNOMON_API bool joinsFrames(const LightPlan& light);

} // namespace gnomon::pack
