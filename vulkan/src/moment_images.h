// SPDX-License-Identifier: Apache-2.0
// Images and buffers that filterable maps are made with, and what each pass over them is told of the view.
#pragma once

#include "filter_layout.h"

namespace gnomon::vulkan {

/// How a tile lies in the scratch image: cut into strips of this width, each in a layer (gnomon/lib/scratch.glsl).
struct ScratchStrips {
    std::uint32_t width = shared::kBlockTexels;
    std::uint32_t count = 1; // for each image layer of the map
};
/// As narrow as blocks, or as wide as it takes for all strips to have a layer.
[[nodiscard]] ScratchStrips stripsOf(std::uint32_t tile_width, std::uint32_t image_layers, std::uint32_t most_layers);

struct MomentImages {
    Image maps;
    Image depth;                            // one layer, drawn and read view by view, each from the first texel on
    Image scratch;                          // a tile blurred along x, in strips; empty without blur
    ScratchStrips strips;                   // strips of `scratch`
    DeviceBuffer blocks;                    // flags of the tile's blocks, see filter_pass.glsl
    HostBuffer kernel;                      // BlurKernel
    HostBuffer counts;                      // BlurCounts, one a slot
    VkBuffer depth_layers = VK_NULL_HANDLE; // LayerPlacer's

    /// The bindings of a pass from one image to another.
    [[nodiscard]] FilterBindings between(VkImageView source, VkImageView target) const
    {
        return {source, false, target, blocks.buffer(), depth_layers, kernel.buffer(), counts.buffer()};
    }
};

/// One view's map.
struct FilterStep {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    Tile tile;
    std::uint32_t first_layer = 0; // layer of the maps' image
    std::uint32_t image_layers = 1;
    ScratchStrips strips;
    std::uint32_t depth_slot = 0; // slot of its layers of depth
    float near_over_far = 1.0F;
    std::uint32_t counts_offset = 0; // offset of its BlurCounts
};

[[nodiscard]] constexpr std::uint32_t groupsOf(std::uint32_t count, std::uint32_t size)
{
    return (count + size - 1) / size;
}

/// From and to the view's tile in the maps.
[[nodiscard]] shared::FilterPassPlace placeOf(const FilterStep& step);
/// Makes writes of compute and fragment shaders visible to the next ones.
void waitForShaders(const Device& device, VkCommandBuffer commands);

} // namespace gnomon::vulkan
