// SPDX-License-Identifier: Apache-2.0
#include "barriers.h"

namespace gnomon::vulkan {

void BarrierBatch::add(const ImageBarrier& barrier)
{
    if (image_count_ == kMost) {
        record();
    }
    VkImageMemoryBarrier2& image = images_[image_count_++];
    image = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    image.srcStageMask = barrier.source_stages;
    image.srcAccessMask = barrier.source_access;
    image.dstStageMask = barrier.target_stages;
    image.dstAccessMask = barrier.target_access;
    image.oldLayout = barrier.old_layout;
    image.newLayout = barrier.new_layout;
    image.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    image.image = barrier.image;
    image.subresourceRange = {barrier.aspect, 0, VK_REMAINING_MIP_LEVELS, barrier.first_layer, barrier.layer_count};
}

void BarrierBatch::add(const MemoryBarrier& barrier)
{
    if (memory_count_ == kMost) {
        record();
    }
    VkMemoryBarrier2& memory = memory_[memory_count_++];
    memory = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    memory.srcStageMask = barrier.source_stages;
    memory.srcAccessMask = barrier.source_access;
    memory.dstStageMask = barrier.target_stages;
    memory.dstAccessMask = barrier.target_access;
}

void BarrierBatch::record()
{
    if (image_count_ + memory_count_ == 0) {
        return;
    }
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = image_count_;
    dependency.pImageMemoryBarriers = images_.data();
    dependency.memoryBarrierCount = memory_count_;
    dependency.pMemoryBarriers = memory_.data();
    device_.vk.CmdPipelineBarrier2(commands_, &dependency);
    image_count_ = 0;
    memory_count_ = 0;
}

} // namespace gnomon::vulkan
