// SPDX-License-Identifier: Apache-2.0
#include "layered_target.h"

#include "barriers.h"
#include "draw_view.h"

#include <algorithm>

namespace gnomon::vulkan {
namespace {

VkImageLayout attachmentLayout(bool depth)
{
    return depth ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}
VkPipelineStageFlags2 attachmentStages(bool depth)
{
    return depth ? kDepthStages : VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
}
VkAccessFlags2 writeAccess(bool depth)
{
    return depth ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT : VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
}
VkAccessFlags2 attachmentAccess(bool depth)
{
    return depth ? kDepthAccess : VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
}

} // namespace

void LayeredTarget::grow(Device& device, ImageInfo info)
{
    if (image_) {
        const ImageInfo& have = image_.info();
        info.extent = {std::max(info.extent.width, have.extent.width),
                       std::max(info.extent.height, have.extent.height)};
        info.layers = std::max(info.layers, have.layers);
    }
    Image larger(device, info);
    if (image_) {
        outgrown_.take(device, std::move(image_), std::move(layouts_));
    }
    device_ = &device;
    image_ = std::move(larger);
    layouts_.assign(info.layers, VK_IMAGE_LAYOUT_UNDEFINED);
}

void LayeredTarget::copyOutgrown(VkCommandBuffer commands)
{
    if (!outgrown_) {
        return;
    }
    BarrierBatch barriers(*device_, commands);
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (!outgrown_.holds(layer)) {
            continue;
        }
        ImageBarrier barrier = barrierOf(layer);
        barrier.new_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barriers.add(barrier);
        layouts_[layer] = barrier.new_layout;
    }
    barriers.record();
    outgrown_.copyTo(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (layouts_[layer] != VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL) {
            continue;
        }
        ImageBarrier barrier = barrierOf(layer);
        barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.target_stages = kMapReaders;
        barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        barriers.add(barrier);
        layouts_[layer] = barrier.new_layout;
    }
}

ImageBarrier LayeredTarget::barrierOf(std::uint32_t layer) const
{
    ImageBarrier barrier;
    barrier.image = image_.image();
    barrier.aspect = image_.info().aspect;
    barrier.first_layer = layer;
    barrier.old_layout = layouts_[layer];
    return barrier;
}

void LayeredTarget::toAttachment(BarrierBatch& barriers, std::uint32_t layer)
{
    // Layers that keep some of their tiles must not lose them in the transition; so the old layout is named, not
    // UNDEFINED.
    ImageBarrier barrier = barrierOf(layer);
    barrier.new_layout = attachmentLayout(isDepth());
    barrier.source_stages = kMapReaders; // the last frame's reads come first; there is nothing to make visible
    barrier.target_stages = attachmentStages(isDepth());
    barrier.target_access = attachmentAccess(isDepth());
    barriers.add(barrier);
    layouts_[layer] = barrier.new_layout;
}

void LayeredTarget::toReadable(BarrierBatch& barriers, std::uint32_t layer)
{
    ImageBarrier barrier = barrierOf(layer);
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    if (layouts_[layer] != VK_IMAGE_LAYOUT_UNDEFINED) {
        barrier.source_stages = attachmentStages(isDepth());
        barrier.source_access = writeAccess(isDepth());
    }
    barrier.target_stages = kMapReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    barriers.add(barrier);
    layouts_[layer] = barrier.new_layout;
}

void LayeredTarget::makeReadable(BarrierBatch& barriers)
{
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (layouts_[layer] != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
            toReadable(barriers, layer);
        }
    }
}

void LayeredTarget::waitForDrawing(BarrierBatch& barriers, std::uint32_t layer) const
{
    ImageBarrier barrier = barrierOf(layer);
    barrier.new_layout = barrier.old_layout;
    barrier.source_stages = attachmentStages(isDepth());
    barrier.source_access = writeAccess(isDepth());
    barrier.target_stages = attachmentStages(isDepth());
    barrier.target_access = attachmentAccess(isDepth());
    barriers.add(barrier);
}

bool LayeredTarget::covers(VkExtent2D extent, std::uint32_t layers) const
{
    return image_ && image_.info().extent.width >= extent.width && image_.info().extent.height >= extent.height &&
           image_.info().layers >= layers;
}

} // namespace gnomon::vulkan
