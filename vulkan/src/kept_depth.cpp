// SPDX-License-Identifier: Apache-2.0
#include "kept_depth.h"

#include "barriers.h"

#include <algorithm>

namespace gnomon::vulkan {
namespace {

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

bool KeptDepth::covers(VkExtent2D extent, std::uint32_t layers) const
{
    const ImageInfo& have = image_.info();
    return layers == 0 || (image_ && have.extent.width >= extent.width && have.extent.height >= extent.height &&
                           have.layers >= layers);
}

void KeptDepth::grow(VkFormat format, VkSampleCountFlagBits samples, VkExtent2D extent, std::uint32_t layers)
{
    ImageInfo info;
    info.format = format;
    info.extent = extent;
    info.layers = layers;
    info.usage =
        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    info.purpose = "kept shadow maps";
    info.samples = samples;
    if (image_) {
        const ImageInfo& have = image_.info();
        info.extent = {std::max(extent.width, have.extent.width), std::max(extent.height, have.extent.height)};
        info.layers = std::max(layers, have.layers);
    }
    Image larger(device_, info);
    if (image_) {
        outgrown_.take(device_, std::move(image_), std::move(layouts_));
    }
    image_ = std::move(larger);
    layouts_.assign(info.layers, VK_IMAGE_LAYOUT_UNDEFINED);
}

void KeptDepth::copyOutgrown(VkCommandBuffer commands)
{
    if (!outgrown_) {
        return;
    }
    const auto toLayout = [&](std::uint32_t layer, VkImageLayout layout) {
        ImageBarrier barrier = barrierOf(image_, layer);
        barrier.old_layout = layouts_[layer];
        barrier.new_layout = layout;
        barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.target_access = VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
        recordBarrier(device_, commands, barrier);
        layouts_[layer] = layout;
    };
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (outgrown_.holds(layer)) {
            toLayout(layer, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        }
    }
    outgrown_.copyTo(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (layouts_[layer] == VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL) {
            toLayout(layer, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        }
    }
}

void KeptDepth::draw(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    VkImageLayout& layout = layouts_[view.contents.kept_layer];
    ImageBarrier barrier = barrierOf(image_, view.contents.kept_layer);
    barrier.old_layout = layout;
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT; // the old contents may have been copied just now
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    recordBarrier(device_, job.commands, barrier);
    beginDepthRendering(device_, job.commands, view.place.tile, image_.layer(view.contents.kept_layer),
                        VK_ATTACHMENT_LOAD_OP_CLEAR);
    drawView(job, index, pack::CasterShare::still, 0);
    device_.vk.CmdEndRendering(job.commands);
    layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.old_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.new_layout = layout;
    barrier.source_stages = kDepthStages;
    barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_READ_BIT;
    recordBarrier(device_, job.commands, barrier);
}

void KeptDepth::restore(VkCommandBuffer commands, const View& view, const Image& working) const
{
    ImageBarrier barrier = barrierOf(working, 0);
    barrier.new_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL; // the last view's contents are not needed
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    recordBarrier(device_, commands, barrier);
    const VkOffset3D first{static_cast<std::int32_t>(view.place.tile.x), static_cast<std::int32_t>(view.place.tile.y),
                           0};
    VkImageCopy copy{};
    copy.srcSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, view.contents.kept_layer, 1};
    copy.dstSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    copy.srcOffset = first;
    copy.extent = {view.place.tile.width, view.place.tile.height, 1};
    device_.vk.CmdCopyImage(commands, image_.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, working.image(),
                            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    barrier.old_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    recordBarrier(device_, commands, barrier);
}

} // namespace gnomon::vulkan
