// SPDX-License-Identifier: Apache-2.0
// The draws of the pass that makes the mask. A pixel outside of the band that joins two positions of a stepping sun
// must not pay for both, whatever a device makes of branches: so a layer of the mask is drawn in upright strips, each
// with what it needs alone. And lights whose options differ are read by different filters: each has a draw of its own.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <gpu_structs.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon::pack {

/// Which positions of a sun are seen.
enum class SunShown : std::uint8_t { all, earlier, later };

/// A triangle over a strip of one layer of the mask. Before the first draw the layer is 1 all over: lights without a
/// map have no draw.
struct MaskDraw {
    std::uint32_t layer = 0;   // of the mask
    std::uint32_t begin = 0;   // the strip: pixels, x
    std::uint32_t end = 0;     // one past it
    std::uint32_t options = 0; // of Plan::options: whose filter reads the maps
    /// Of fillMaskLights(): the place of the layer's channel 0.
    std::uint32_t first_light = 0;
    std::uint32_t channels = 0; // bit i: channel i is drawn; others are to be left as they are
    bool coloured = false;      // LightPlan::mask_coloured: all four channels are of one light
    std::array<SunShown, shared::kLightsPerLayer> shown{}; // by channel
    bool orthographic = true;                              // every view of its lights is
    bool shares = false;                                   // another draw has further channels of the strip
    std::uint32_t few_views = 0;                           // fewViews(), where the plan has one light
};

/// A light that is never seen from two positions, alone in a plan, may have few views: then the mask's shader is one
/// that looks among so many, 1 or kFewViews, of which some may be left over (fillViews()). Else 0.
[[nodiscard]] std::uint32_t fewViews(const ResolvedOptions& options);
/// The draws for a screen of this width, in order. Keeps what `out` has allocated.
void listMaskDraws(const Plan& plan, std::uint32_t width_px, std::vector<MaskDraw>& out);
/// How many places fillMaskLights() needs at most for a plan like this one, however its suns stand.
[[nodiscard]] std::uint32_t maskLightCount(const Plan& plan);
/// What the draws read: at MaskDraw::first_light + channel the light that has this channel, a coloured one four times.
/// Throws Error where there is no room for that, or the frame has other lights than the plan.
void fillMaskLights(const Frame& frame, const Plan& plan, std::span<const MaskDraw> draws,
                    std::span<shared::GpuLight> lights);

} // namespace gnomon::pack
