// SPDX-License-Identifier: Apache-2.0
// Images and buffers that filterable maps are made with, and what each pass over them is told of the view.
#pragma once

#include "filter_layout.h"

namespace gnomon::vulkan {

struct MomentImages {
    Image maps;
    Image depth;                            // one layer, drawn and read view by view, each from the first texel on
    Image scratch;                          // a tile blurred along x, in strips; empty without blur
    pack::ScratchStrips strips;             // strips of `scratch`
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

/// One view's map, and where its passes are recorded.
struct FilterStep : pack::FilterStep {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint32_t counts_offset = 0; // offset of its BlurCounts
};

/// Makes writes of compute and fragment shaders visible to the next ones.
void waitForShaders(const Device& device, VkCommandBuffer commands);

} // namespace gnomon::vulkan
