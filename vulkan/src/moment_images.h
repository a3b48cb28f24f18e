// SPDX-License-Identifier: Apache-2.0
// Images and buffers that filterable maps are made with, and what each pass over them is told of the view.
#pragma once

#include "filter_layout.h"

namespace gnomon::vulkan {

struct MomentImages {
    Image maps;
    Image depth;                            // one layer, drawn and read view by view, each from the first texel on
    Image scratch;                          // a tile blurred along x, likewise; empty without blur
    DeviceBuffer blocks;                    // flags of the tile's blocks, see filter_pass.glsl
    HostBuffer kernel;                      // BlurKernel
    HostBuffer counts;                      // BlurCounts, one a slot
    VkBuffer depth_layers = VK_NULL_HANDLE; // LayerPlacer's

    /// What a pass from one image to another is bound to.
    [[nodiscard]] FilterBindings between(VkImageView source, VkImageView target) const
    {
        return {source, false, target, blocks.buffer(), depth_layers, kernel.buffer(), counts.buffer()};
    }
};

/// One view's map.
struct FilterStep {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    Tile tile;
    std::uint32_t first_layer = 0; // of the maps' image
    std::uint32_t image_layers = 1;
    std::uint32_t depth_slot = 0; // of its layers of depth
    float near_over_far = 1.0F;
    std::uint32_t counts_offset = 0; // of its BlurCounts
};

[[nodiscard]] constexpr std::uint32_t groupsOf(std::uint32_t count, std::uint32_t size)
{
    return (count + size - 1) / size;
}

/// From and to the view's tile in the maps.
[[nodiscard]] shared::FilterPassPlace placeOf(const FilterStep& step);
/// What compute and fragment shaders wrote is visible to those that come next.
void waitForShaders(const Device& device, VkCommandBuffer commands);

} // namespace gnomon::vulkan
