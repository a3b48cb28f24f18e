// SPDX-License-Identifier: Apache-2.0
#include "map_pass.h"

#include "draw_view.h"
#include "timed.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

VkImageLayout attachmentLayout(const MapStorage& storage)
{
    return storage.depthOnly() ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}
VkPipelineStageFlags2 attachmentStages(const MapStorage& storage)
{
    return storage.depthOnly() ? kDepthStages : VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
}
VkAccessFlags2 attachmentAccess(const MapStorage& storage)
{
    return storage.depthOnly() ? kDepthAccess : VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
}

} // namespace

bool DepthMaps::prepare(const Plan& plan)
{
    const AtlasSize& atlas = plan.atlas;
    const AtlasSize need{std::max(atlas.width, 1U), std::max(atlas.height, 1U), std::max(atlas.layers, 1U)};
    if (maps_ && maps_.info().extent.width >= need.width && maps_.info().extent.height >= need.height &&
        maps_.info().layers >= need.layers) {
        return false;
    }
    // Free the old images first, so that growing does not need room for both.
    maps_ = {};
    depth_ = {};
    const VkExtent2D extent{need.width, need.height};
    const VkImageUsageFlags attachment =
        storage_.depthOnly() ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    maps_ = Image(device_, {storage_.mapFormat(), extent, need.layers,
                            attachment | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            storage_.aspect(), "shadow maps"});
    if (!storage_.depthOnly()) {
        depth_ = Image(device_, {storage_.depth, extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT, "shadow map depth"});
    }
    layouts_.assign(need.layers, VK_IMAGE_LAYOUT_UNDEFINED);
    redraw_all_ = true;
    return true;
}

MapPassFormats DepthMaps::formats(bool orthographic) const
{
    return {storage_.colour, storage_.depth, VK_SAMPLE_COUNT_1_BIT, storage_.depthOnly() && !orthographic};
}

bool DepthMaps::layerIsDrawn(const Plan& plan, std::uint32_t layer) const
{
    return std::any_of(plan.views.begin(), plan.views.end(),
                       [&](const View& view) { return view.tile.layer == layer && (view.redraw || redraw_all_); });
}

void DepthMaps::toAttachment(VkCommandBuffer commands, std::uint32_t layer)
{
    ImageBarrier barrier;
    barrier.image = maps_.image();
    barrier.aspect = storage_.aspect();
    barrier.first_layer = layer;
    barrier.old_layout = layouts_[layer];
    barrier.new_layout = attachmentLayout(storage_);
    barrier.source_stages = kMapReaders; // the last frame's reads come first; there is nothing to make visible
    barrier.target_stages = attachmentStages(storage_);
    barrier.target_access = attachmentAccess(storage_);
    recordBarrier(device_, commands, barrier);
    layouts_[layer] = barrier.new_layout;
}

void DepthMaps::toReadable(VkCommandBuffer commands, std::uint32_t layer)
{
    ImageBarrier barrier;
    barrier.image = maps_.image();
    barrier.aspect = storage_.aspect();
    barrier.first_layer = layer;
    barrier.old_layout = layouts_[layer];
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    if (layouts_[layer] != VK_IMAGE_LAYOUT_UNDEFINED) {
        barrier.source_stages = attachmentStages(storage_);
        barrier.source_access = storage_.depthOnly() ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
                                                     : VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    }
    barrier.target_stages = kMapReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    recordBarrier(device_, commands, barrier);
    layouts_[layer] = barrier.new_layout;
}

void DepthMaps::makeReadable(VkCommandBuffer commands)
{
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (layouts_[layer] != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
            toReadable(commands, layer);
        }
    }
}

void DepthMaps::beginRendering(VkCommandBuffer commands, const Tile& tile)
{
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = storage_.depthOnly() ? maps_.layer(tile.layer) : depth_.layer(0);
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = storage_.depthOnly() ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.clearValue.depthStencil = {1.0F, 0};

    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = maps_.layer(tile.layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color = {{1.0F, 1.0F, 1.0F, 1.0F}};

    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = areaOf(tile);
    info.layerCount = 1;
    info.colorAttachmentCount = storage_.depthOnly() ? 0U : 1U;
    info.pColorAttachments = storage_.depthOnly() ? nullptr : &colour;
    info.pDepthAttachment = &depth;
    device_.vk.CmdBeginRendering(commands, &info);

    setViewport(device_, commands, tile);
}

void DepthMaps::recordView(VkCommandBuffer commands, const Plan& plan, std::uint32_t index, const DrawCasters& draw)
{
    const Tile& tile = plan.views[index].tile;
    assert(tile.x + tile.width <= maps_.info().extent.width && tile.y + tile.height <= maps_.info().extent.height);
    beginViewLabel(device_, commands, plan, index);
    if (!storage_.depthOnly()) {
        ImageBarrier barrier;
        barrier.image = depth_.image();
        barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
        barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        barrier.source_stages = kDepthStages;
        barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        barrier.target_stages = kDepthStages;
        barrier.target_access = kDepthAccess;
        recordBarrier(device_, commands, barrier);
    }
    beginRendering(commands, tile);
    drawView(commands, plan, index, draw);
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void DepthMaps::record(VkCommandBuffer commands, [[maybe_unused]] std::uint32_t slot, const Plan& plan,
                       const DrawCasters& draw, Profiler* profiler)
{
    const Timed timed(profiler, commands, "shadow maps");
    // Layers that keep some of their tiles must not lose them in the transition; so the old layout is named, not
    // UNDEFINED.
    for (std::uint32_t layer = 0; layer < layouts_.size(); ++layer) {
        if (layerIsDrawn(plan, layer)) {
            toAttachment(commands, layer);
        }
    }
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        if (plan.views[i].redraw || redraw_all_) {
            recordView(commands, plan, i, draw);
        }
    }
    redraw_all_ = false;
    makeReadable(commands);
}

} // namespace gnomon::vulkan
