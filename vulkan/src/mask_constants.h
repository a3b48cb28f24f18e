// SPDX-License-Identifier: Apache-2.0
// What the mask pass's shaders read, worked out from frame and plan: everything relative to the eye, in double
// precision until the last moment.
#pragma once

#include <gnomon/vulkan/shadow_renderer.h>

#include <gpu_structs.h>

namespace gnomon::vulkan {

/// How many texels from the receiver, per axis, the centres of a filter's texels can be.
[[nodiscard]] float filterReachTexels(const FilterOptions& filter);
/// Width of a separable kernel; 0 for the discs.
[[nodiscard]] int kernelWidth(const FilterOptions& filter);

/// Fills one layer of the mask. Precondition: at most kViewsPerLayer views in the layer.
void fillMaskLayer(const Frame& frame, const Plan& plan, std::uint32_t layer, const FilterOptions& filter,
                   float quantum, VkExtent2D screen, VkExtent2D atlas, shared::GpuMaskLayer& out);
/// Views that the lights of a layer have together.
[[nodiscard]] std::uint32_t countMaskLayerViews(const Plan& plan, std::uint32_t layer);
/// True when every view of the layer's lights is orthographic.
[[nodiscard]] bool isLayerOrthographic(const Plan& plan, std::uint32_t layer);

} // namespace gnomon::vulkan
