// SPDX-License-Identifier: Apache-2.0
#include "outgrown_image.h"

#include "barriers.h"

#include <algorithm>

namespace gnomon::vulkan {

void OutgrownImage::take(Device& device, Image&& image, std::vector<VkImageLayout> layouts)
{
    letGo();
    const bool empty = std::all_of(layouts.begin(), layouts.end(),
                                   [](VkImageLayout layout) { return layout == VK_IMAGE_LAYOUT_UNDEFINED; });
    if (image_ || empty) {
        device.retire(std::move(image));
        return;
    }
    device_ = &device;
    image_ = std::move(image);
    layouts_ = std::move(layouts);
}

void OutgrownImage::drop()
{
    if (image_) {
        device_->retire(std::move(image_));
        image_ = {};
        layouts_.clear();
        copied_ = false;
    }
}

void OutgrownImage::letGo()
{
    if (copied_) {
        drop();
    }
}

void OutgrownImage::copyTo(VkCommandBuffer commands, const Image& to, VkImageLayout layout)
{
    const ImageInfo& info = image_.info();
    BarrierBatch barriers(*device_, commands);
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (holds(layer)) {
            ImageBarrier barrier;
            barrier.image = image_.image();
            barrier.aspect = info.aspect;
            barrier.first_layer = layer;
            barrier.old_layout = layouts_[layer];
            barrier.new_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
            barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
            barrier.source_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
            barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
            barrier.target_access = VK_ACCESS_2_TRANSFER_READ_BIT;
            barriers.add(barrier);
        }
    }
    barriers.record();
    const std::uint32_t levels = std::min(info.levels, to.info().levels);
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        for (std::uint32_t level = 0; holds(layer) && level < levels; ++level) {
            VkImageCopy copy{};
            copy.srcSubresource = {info.aspect, level, layer, 1};
            copy.dstSubresource = copy.srcSubresource;
            copy.extent = {std::max(info.extent.width >> level, 1U), std::max(info.extent.height >> level, 1U), 1};
            device_->vk.CmdCopyImage(commands, image_.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.image(), layout,
                                     1, &copy);
        }
    }
    copied_ = true;
}

} // namespace gnomon::vulkan
