// SPDX-License-Identifier: Apache-2.0
// The draws of the pass that makes the mask. A pixel outside of the band that joins two positions of a stepping sun
// must not pay for both, whatever a device makes of branches: so a layer of the mask is drawn in upright strips, each
// with what it needs alone. And lights whose options differ are read by different filters: each has a draw of its own.
// A lamp reaches a part of the screen: a layer is drawn in rectangles, each with the lights that reach it.
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
    tests,  // each has a slice and a sector of its own; also where views are not few
    slices, // by slices of one depth, which they all count in
    alone   // there is one, of each position of the sun that is seen, which serves all that is on its map
};

/// A triangle over a rectangle of one layer of the mask. Before the first draw the layer is 1 all over: lights without
/// a map have no draw, and others none where they do not reach.
struct MaskDraw {
    std::uint32_t layer = 0;   // of the mask
    ScreenBounds pixels;       // never empty
    std::uint32_t options = 0; // of Plan::options: whose filter reads the maps
    /// Of fillMaskLights(): the place of the layer's channel 0.
    std::uint32_t first_light = 0;
    std::uint32_t channels = 0; // bit i: channel i is drawn; others are to be left as they are
    bool coloured = false;      // LightPlan::mask_coloured: all four channels are of one light
    std::array<SunShown, shared::kLightsPerLayer> shown{}; // by channel
    bool orthographic = true;                              // every view of its lights is
    bool shares = false;                                   // other draws may have further channels of these pixels
    std::uint32_t few_views = 0;                           // fewViewsOf() the only light with views
    ToldApart told_apart = ToldApart::tests;               // how a point's view is found
    bool paired = false; // alone: two positions of the sun are seen, by orthographic views

    bool operator==(const MaskDraw&) const = default;
};

/// The draws for a screen of this size, in order, each light's within its screenBounds(). A light without a range
/// reaches as far as the frame's objects, and everything where it has none; so does a light that Plan::made_for does
/// not have. What such a draw needs, its options, kinds of views and shares, is the same wherever lights are. Keeps
/// what `out` has allocated.
GNOMON_API void listMaskDraws(const Plan& plan, glm::uvec2 size_px, std::vector<MaskDraw>& out);
/// Of an image of half the size the texels whose pixels these are, by gnomon/shared/mask_upsample.h: what is drawn to
/// it of such a draw. Draws side by side have no texel in common. Empty where there is none.
[[nodiscard]] GNOMON_API ScreenBounds halfTexels(const ScreenBounds& pixels, glm::uvec2 size_px);
/// How many draws there are at most for a plan like this one, wherever its lights reach and however its suns stand.
[[nodiscard]] GNOMON_API std::size_t mostMaskDraws(const Plan& plan);
/// How many places fillMaskLights() needs at most for a plan like this one, however its suns stand.
[[nodiscard]] GNOMON_API std::uint32_t maskLightCount(const Plan& plan);
/// What the draws read: at MaskDraw::first_light + channel the light that has this channel, a coloured one four times.
/// Throws Error where there is no room for that, or Plan::made_for has other lights.
GNOMON_API void fillMaskLights(const Plan& plan, std::span<const MaskDraw> draws, std::span<shared::GpuLight> lights);

} // namespace gnomon::pack
