// SPDX-License-Identifier: Apache-2.0
#include "mask_marks.h"

#include "barriers.h"

#include <cassert>
#include <utility>

namespace gnomon::vulkan {
namespace {

constexpr VkPipelineStageFlags2 kTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

VkPipelineDepthStencilStateCreateInfo stateOf(VkCompareOp passes, VkBool32 writes)
{
    VkPipelineDepthStencilStateCreateInfo state{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    state.depthTestEnable = VK_TRUE; // without it nothing is written
    state.depthWriteEnable = writes;
    state.depthCompareOp = passes;
    return state;
}

void waitForDraws(const Device& device, VkCommandBuffer commands, const Image& target)
{
    ImageBarrier drawn_to;
    drawn_to.image = target.image();
    drawn_to.layer_count = target.info().layers;
    drawn_to.old_layout = drawn_to.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    drawn_to.source_stages = drawn_to.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    drawn_to.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    drawn_to.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, commands, drawn_to);
}

} // namespace

VkPipelineDepthStencilStateCreateInfo MaskMarks::marking()
{
    return stateOf(VK_COMPARE_OP_ALWAYS, VK_TRUE);
}

VkPipelineDepthStencilStateCreateInfo MaskMarks::whereLeft()
{
    return stateOf(VK_COMPARE_OP_LESS, VK_FALSE);
}

/// Two steps of the format from draw to draw: what is left is drawn at the depth between, so that no rounding counts.
VkViewport MaskMarks::viewport(VkExtent2D extent, std::uint32_t i, bool left)
{
    assert(i < kMostDraws);
    constexpr std::uint32_t kSteps = 65535;
    const float depth = static_cast<float>(kSteps - 2 * (i + 1) + (left ? 1U : 0U)) / static_cast<float>(kSteps);
    return {0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height), depth, depth};
}

void MaskMarks::prepare(Device& device, VkExtent2D extent)
{
    if (!holds(extent)) {
        Image image(device, {kFormat, extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT,
                             "mask marks"});
        device.retire(std::move(image_));
        image_ = std::move(image);
    }
}

bool MaskMarks::holds(VkExtent2D extent) const
{
    return image_ && image_.info().extent.width == extent.width && image_.info().extent.height == extent.height;
}

void MaskMarks::begin(const Device& device, VkCommandBuffer commands, const Image& target, std::uint32_t layer,
                      bool keeps) const
{
    if (keeps) {
        waitForDraws(device, commands, target);
    }
    ImageBarrier free; // after the last layer, or the last frame
    free.image = image_.image();
    free.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    free.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    free.source_stages = free.target_stages = kTests;
    free.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    free.target_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, commands, free);
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = keeps ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color = {{1.0F, 1.0F, 1.0F, 1.0F}};
    VkRenderingAttachmentInfo marks{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    marks.imageView = image_.layer(0);
    marks.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    marks.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    marks.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    marks.clearValue.depthStencil = {1.0F, 0};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = target.info().extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    info.pDepthAttachment = &marks;
    device.vk.CmdBeginRendering(commands, &info);
}

} // namespace gnomon::vulkan
