// SPDX-License-Identifier: Apache-2.0
// What the mask pass's shaders read, worked out from frame and plan: everything relative to the eye, in double
// precision until the last moment.
#pragma once

#include "layer_placer.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <gpu_structs.h>

namespace gnomon::vulkan {

/// Width of a separable kernel; 0 for the discs.
[[nodiscard]] int kernelWidth(const FilterOptions& filter);

/// What the mask is made from and into.
struct MaskSurroundings {
    const FilterOptions& filter;
    float quantum; // error of a stored depth, as a metric difference
    VkExtent2D screen;
    VkExtent2D atlas;
    std::uint32_t map_levels;  // mip levels of the maps
    const LayerPlacer& placer; // that the plan was prepared with
};
/// Fills one layer of the mask. Precondition: room for the further views (kViewsPerLayer - kLightsPerLayer).
void fillMaskLayer(const Frame& frame, const Plan& plan, std::uint32_t layer, const MaskSurroundings& around,
                   shared::GpuMaskLayer& out);
/// What the lights of one layer have in common: decides which pipeline draws it.
struct MaskLayerShape {
    std::uint32_t lights = 0;        // channels in use
    std::uint32_t further_views = 0; // beyond the first of each light
    bool orthographic = true;        // every view is
};
[[nodiscard]] MaskLayerShape describeMaskLayer(const Plan& plan, std::uint32_t layer);

} // namespace gnomon::vulkan
