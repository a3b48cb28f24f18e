// SPDX-License-Identifier: Apache-2.0
// What the mask pass's shaders read, worked out from frame and plan: everything relative to the eye, in double
// precision until the last moment.
#pragma once

#include "layer_placer.h"
#include "mask_regions.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <gpu_structs.h>

namespace gnomon::vulkan {

/// What the mask is made from and into.
struct MaskSurroundings {
    const FilterOptions& filter;
    float quantum; // error of a stored depth, as a metric difference
    VkExtent2D screen;
    VkExtent2D atlas;
    std::uint32_t map_levels;  // mip levels of the maps
    const LayerPlacer& placer; // that the plan was prepared with
};
/// One draw of the mask pass.
struct MaskDraw {
    std::uint32_t layer = 0; // of the mask
    std::uint32_t begin = 0; // a strip of the screen: pixels, x
    std::uint32_t end = 0;
    std::uint32_t first_light = 0; // of fillMaskLights(): of the layer's channel 0
    std::uint32_t channels = 0;    // bit i: channel i is drawn
    bool orthographic = true;      // every view is
    std::uint32_t few_views = 0;   // fewViews()
};

/// How many views the plan has where it is of one light that is never seen from two positions, and they are few: for
/// these the mask has a shader of its own. Else 0.
[[nodiscard]] std::uint32_t fewViews(const Plan& plan);

/// How many places fillMaskLights() needs at most. `strips`: a light may have a band (SunSteps::band).
[[nodiscard]] std::uint32_t maskLightCount(std::uint32_t layers, bool strips);
/// Light i of the frame goes to place 4 * mask_layer + mask_channel, and serves all of the screen; what the strips'
/// draws read follows. Lights without a map and places without a light have no views.
void fillMaskLights(const Frame& frame, const Plan& plan, std::uint32_t width, std::span<shared::GpuLight> lights,
                    std::vector<MaskDraw>& draws);
/// Each of the plan's views at its own index.
void fillMaskViews(const Frame& frame, const Plan& plan, const MaskSurroundings& around,
                   std::span<shared::GpuView> views);
void fillMaskConstants(const Frame& frame, const Plan& plan, const MaskSurroundings& around, shared::GpuConstants& out);

} // namespace gnomon::vulkan
