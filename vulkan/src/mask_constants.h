// SPDX-License-Identifier: Apache-2.0
// What the mask pass's shaders read, worked out from frame and plan: everything relative to the eye, in double
// precision until the last moment.
#pragma once

#include "layer_placer.h"
#include "mask_regions.h"

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
/// What the lights of one layer have in common, in one of its regions: decides which pipeline draws it.
struct MaskLayerShape {
    std::uint32_t lights = 0;        // channels in use
    std::uint32_t further_views = 0; // beyond the first of each light and position
    std::uint32_t paired = 0;        // bit i: the light of channel i is seen from two positions
    bool orthographic = true;        // every view is
};
[[nodiscard]] MaskLayerShape describeMaskLayer(const Plan& plan, std::uint32_t layer, const MaskRegion& region);
/// How many places of GpuMaskLayer::views are for first views.
[[nodiscard]] constexpr std::uint32_t firstViews(const MaskLayerShape& shape)
{
    return shape.paired != 0 ? 2U * shared::kLightsPerLayer : shared::kLightsPerLayer;
}
/// Fills one region of one layer of the mask. Precondition: room for the further views.
void fillMaskLayer(const Frame& frame, const Plan& plan, std::uint32_t layer, const MaskRegion& region,
                   const MaskSurroundings& around, shared::GpuMaskLayer& out);

} // namespace gnomon::vulkan
