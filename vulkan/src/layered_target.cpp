// SPDX-License-Identifier: Apache-2.0
#include "layered_target.h"

#include "draw_view.h"

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

LayeredTarget::LayeredTarget(Device& device, const ImageInfo& info)
    : device_(&device), image_(device, info), layouts_(info.layers, VK_IMAGE_LAYOUT_UNDEFINED)
{
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

void LayeredTarget::toAttachment(VkCommandBuffer commands, std::uint32_t layer)
{
    // Layers that keep some of their tiles must not lose them in the transition; so the old layout is named, not
    // UNDEFINED.
    ImageBarrier barrier = barrierOf(layer);
    barrier.new_layout = attachmentLayout(isDepth());
    barrier.source_stages = kMapReaders; // the last frame's reads come first; there is nothing to make visible
    barrier.target_stages = attachmentStages(isDepth());
    barrier.target_access = attachmentAccess(isDepth());
    recordBarrier(*device_, commands, barrier);
    layouts_[layer] = barrier.new_layout;
}

void LayeredTarget::toReadable(VkCommandBuffer commands, std::uint32_t layer)
{
    ImageBarrier barrier = barrierOf(layer);
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    if (layouts_[layer] != VK_IMAGE_LAYOUT_UNDEFINED) {
        barrier.source_stages = attachmentStages(isDepth());
        barrier.source_access = writeAccess(isDepth());
    }
    barrier.target_stages = kMapReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    recordBarrier(*device_, commands, barrier);
    layouts_[layer] = barrier.new_layout;
}

void LayeredTarget::makeReadable(VkCommandBuffer commands)
{
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (layouts_[layer] != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
            toReadable(commands, layer);
        }
    }
}

void LayeredTarget::waitForDrawing(VkCommandBuffer commands, std::uint32_t layer) const
{
    ImageBarrier barrier = barrierOf(layer);
    barrier.new_layout = barrier.old_layout;
    barrier.source_stages = attachmentStages(isDepth());
    barrier.source_access = writeAccess(isDepth());
    barrier.target_stages = attachmentStages(isDepth());
    barrier.target_access = attachmentAccess(isDepth());
    recordBarrier(*device_, commands, barrier);
}

bool LayeredTarget::covers(VkExtent2D extent, std::uint32_t layers) const
{
    return image_ && image_.info().extent.width >= extent.width && image_.info().extent.height >= extent.height &&
           image_.info().layers >= layers;
}

} // namespace gnomon::vulkan
