// SPDX-License-Identifier: Apache-2.0
#include "moment_images.h"

#include "barriers.h"

namespace gnomon::vulkan {

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
