// SPDX-License-Identifier: Apache-2.0
#include "kept_depth.h"

namespace gnomon::vulkan {
namespace {

ImageInfo keptInfo(ImageInfo info, std::uint32_t layers)
{
    info.layers = layers;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    info.purpose = "kept shadow maps";
    return info;
}

ImageBarrier barrierOf(const Image& image, std::uint32_t layer)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    barrier.first_layer = layer;
    return barrier;
}

} // namespace

void beginDepthRendering(const Device& device, VkCommandBuffer commands, const Tile& tile, VkImageView image,
                         VkAttachmentLoadOp load)
{
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = image;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = load;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.clearValue.depthStencil = {1.0F, 0};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = areaOf(tile);
    info.layerCount = 1;
    info.pDepthAttachment = &depth;
    device.vk.CmdBeginRendering(commands, &info);
    setViewport(device, commands, tile);
}

KeptDepth::KeptDepth(Device& device, ImageInfo working, std::uint32_t layers)
    : device_(&device), image_(device, keptInfo(working, layers)), layouts_(layers, VK_IMAGE_LAYOUT_UNDEFINED)
{
}

void KeptDepth::draw(VkCommandBuffer commands, const Plan& plan, std::uint32_t index, const DrawCasters& draw)
{
    const View& view = plan.views[index];
    VkImageLayout& layout = layouts_[view.kept_layer];
    ImageBarrier barrier = barrierOf(image_, view.kept_layer);
    barrier.old_layout = layout;
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT; // what was there may have been copied just now
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    recordBarrier(*device_, commands, barrier);
    beginDepthRendering(*device_, commands, view.tile, image_.layer(view.kept_layer), VK_ATTACHMENT_LOAD_OP_CLEAR);
    drawView(commands, plan, index, CasterShare::still, 0, draw);
    device_->vk.CmdEndRendering(commands);
    layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.old_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.new_layout = layout;
    barrier.source_stages = kDepthStages;
    barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_READ_BIT;
    recordBarrier(*device_, commands, barrier);
}

void KeptDepth::restore(VkCommandBuffer commands, const View& view, const Image& working) const
{
    ImageBarrier barrier = barrierOf(working, 0);
    barrier.new_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL; // what the view before left is not needed
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    recordBarrier(*device_, commands, barrier);
    const VkOffset3D first{static_cast<std::int32_t>(view.tile.x), static_cast<std::int32_t>(view.tile.y), 0};
    VkImageCopy copy{};
    copy.srcSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, view.kept_layer, 1};
    copy.dstSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    copy.srcOffset = first;
    copy.dstOffset = first;
    copy.extent = {view.tile.width, view.tile.height, 1};
    device_->vk.CmdCopyImage(commands, image_.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, working.image(),
                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    barrier.old_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    recordBarrier(*device_, commands, barrier);
}

} // namespace gnomon::vulkan
