// SPDX-License-Identifier: Apache-2.0
#include "moment_images.h"

#include "barriers.h"

namespace gnomon::vulkan {

ScratchStrips stripsOf(std::uint32_t tile_width, std::uint32_t image_layers, std::uint32_t most_layers)
{
    ScratchStrips strips;
    while (groupsOf(tile_width, strips.width) * image_layers > most_layers) {
        strips.width *= 2;
    }
    strips.count = groupsOf(tile_width, strips.width);
    return strips;
}

shared::FilterPassPlace placeOf(const FilterStep& step)
{
    const glm::ivec4 tile(step.tile.x, step.tile.y, step.first_layer, 0);
    shared::FilterPassPlace place{};
    place.source = tile;
    place.source.w = static_cast<int>(step.depth_slot);
    place.target = tile;
    place.target.w = static_cast<int>(step.image_layers);
    place.size = glm::ivec4(step.tile.width, step.tile.height, groupsOf(step.tile.width, shared::kBlockTexels),
                            groupsOf(step.tile.height, shared::kBlockTexels));
    place.strips = glm::ivec4(step.strips.width, step.strips.count, 0, 0);
    place.metric.x = step.near_over_far;
    return place;
}

void waitForShaders(const Device& device, VkCommandBuffer commands)
{
    MemoryBarrier barrier;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                            VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device, commands, barrier);
}

} // namespace gnomon::vulkan
