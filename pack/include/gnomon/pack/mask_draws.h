// SPDX-License-Identifier: Apache-2.0
// The draws of the pass that makes the mask. A layer of the mask is drawn in upright strips, so that a pixel outside of
// the band that joins two positions of a stepping sun does not pay for both, however a device treats branches. Lights
// with different options are read by different filters and have draws of their own. A lamp reaches only a part of the
// screen, so a layer is drawn in rectangles, each with the lights that reach it.
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/light_lists.h>
#include <gnomon/plan.h>

#include <gnomon/shared/gpu_structs.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon::pack {

/// Which positions of a sun are seen.
enum class SunShown : std::uint8_t { all, earlier, later };

/// How a draw finds a point's view among few.
enum class ToldApart : std::uint8_t {
    tests,  // tests each view's slice and sector; also where views are not few
    slices, // by slices of one depth, which all views share
    alone   // there is one view for each sun position that is seen, and it serves its whole map
};

/// A triangle over a rectangle of one layer of the mask. Before the first draw the layer is 1 all over: lights without
/// a map have no draw, and other lights have none where they do not reach.
struct MaskDraw {
    std::uint32_t layer = 0;   // layer of the mask
    ScreenBounds pixels;       // never empty
    std::uint32_t options = 0; // index into Plan::options, whose filter reads the maps
    /// The place of the layer's channel 0 in the lights of fillMaskLights().
    std::uint32_t first_light = 0;
    std::uint32_t channels = 0; // bit i: channel i is drawn; others must be left as they are
    bool coloured = false;      // LightPlan::mask_coloured: all four channels belong to one light
    std::array<SunShown, shared::kLightsPerLayer> shown{}; // by channel
    bool orthographic = true;                              // every view of its lights is
    bool shares = false;                                   // other draws may have further channels of these pixels
    std::uint32_t few_views = 0;                           // fewViewsOf() the only light with views
    ToldApart told_apart = ToldApart::tests;               // how a point's view is found
    bool paired = false; // alone: two positions of the sun are seen, by orthographic views

    bool operator==(const MaskDraw&) const = default;
};

/// The draws for a screen of this size, in order, each light's within its screenBounds(). A light without a range
/// reaches as far as the frame's objects, and everything where there are none; so does a light that Plan::made_for does
/// not have. A draw's options, kinds of views and shares do not depend on where lights are. Keeps the memory of `out`.
GNOMON_API void listMaskDraws(const Plan& plan, glm::uvec2 size_px, std::vector<MaskDraw>& out);
/// The texels of an image of half the size that stand for these pixels (gnomon/shared/mask_upsample.h), which such a
/// draw fills there. Draws side by side have no texel in common. Empty where there is none.
[[nodiscard]] GNOMON_API ScreenBounds halfTexels(const ScreenBounds& pixels, glm::uvec2 size_px);
/// How many draws there are at most for a plan like this one, wherever its lights reach and however its suns stand.
[[nodiscard]] GNOMON_API std::size_t mostMaskDraws(const Plan& plan);
/// How many places fillMaskLights() needs at most for a plan like this one, however its suns stand.
[[nodiscard]] GNOMON_API std::uint32_t maskLightCount(const Plan& plan);
/// Writes the lights that the draws read: at MaskDraw::first_light + channel the light that has this channel, a
/// coloured one four times. Throws Error where there is no room for that, or Plan::made_for has other lights.
GNOMON_API void fillMaskLights(const Plan& plan, std::span<const MaskDraw> draws, std::span<shared::GpuLight> lights);

} // namespace gnomon::pack
