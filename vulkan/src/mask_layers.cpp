// SPDX-License-Identifier: Apache-2.0
// The mask pass's recording of a layer. Most filters are drawn at every pixel. Those that have blocks are drawn where
// blocks settle the pixel, and then at the few pixels where they do not. MaskSize::half takes three steps. One pixel of
// each 2 x 2 is drawn to an image of half the size, that is spread over the mask, and the remaining pixels are drawn.
#include "mask_pass.h"

#include "barriers.h"

#include <gnomon/pack/frame_passes.h>

#include <algorithm>
#include <cstdio>

namespace gnomon::vulkan {
namespace {

VkRect2D rectOf(const pack::ScreenBounds& bounds)
{
    return {{static_cast<std::int32_t>(bounds.x0), static_cast<std::int32_t>(bounds.y0)},
            {bounds.x1 - bounds.x0, bounds.y1 - bounds.y0}};
}

bool beginsAs(const Plan& plan, const pack::MaskDraw& draw, DrawnAs as)
{
    return drawnFirst((*plan.options)[draw.options]) == as;
}

/// A label around what is recorded while it lives.
class MaskLabel {
public:
    MaskLabel(const Device& device, VkCommandBuffer commands, const char* what, std::uint32_t layer)
        : device_(device), commands_(commands)
    {
        char label[32];
        std::snprintf(label, sizeof label, "%s %u", what, layer);
        device.beginLabel(commands, label);
    }
    ~MaskLabel() { device_.endLabel(commands_); }
    MaskLabel(const MaskLabel&) = delete;
    MaskLabel& operator=(const MaskLabel&) = delete;

private:
    const Device& device_;
    VkCommandBuffer commands_;
};

void grow(pack::ScreenBounds& bounds, const pack::ScreenBounds& by)
{
    bounds = bounds.empty() ? by
                            : pack::ScreenBounds{std::min(bounds.x0, by.x0), std::min(bounds.y0, by.y0),
                                                 std::max(bounds.x1, by.x1), std::max(bounds.y1, by.y1)};
}

} // namespace

bool MaskPassRecorder::hasDraws(const Plan& plan, std::uint32_t layer, DrawnAs first) const
{
    return std::ranges::any_of(
        now_.draws, [&](const pack::MaskDraw& draw) { return draw.layer == layer && beginsAs(plan, draw, first); });
}

void MaskPassRecorder::recordDraw(VkCommandBuffer commands, const Plan& plan, const Slot& slot,
                                  const pack::MaskDraw& draw, DrawnAs as)
{
    const glm::uvec2 size_px(mask_.info().extent.width, mask_.info().extent.height);
    const VkRect2D scissor = rectOf(as == DrawnAs::half ? pack::halfTexels(draw.pixels, size_px) : draw.pixels);
    device_.vk.CmdSetScissor(commands, 0, 1, &scissor);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline(plan, draw, *shape_, as));
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1,
                                     &slot.sets[draw.options], 0, nullptr);
    const MaskPush push{draw.first_light, draw.channels};
    device_.vk.CmdPushConstants(commands, layout_.get(), kMaskStages, 0, sizeof push, &push);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

void MaskPassRecorder::recordDraws(VkCommandBuffer commands, const Plan& plan, const Slot& slot, std::uint32_t layer,
                                   DrawnAs first, DrawnAs as)
{
    for (const pack::MaskDraw& draw : now_.draws) {
        if (draw.layer == layer && beginsAs(plan, draw, first)) {
            recordDraw(commands, plan, slot, draw, as);
        }
    }
}

void MaskPassRecorder::recordSettled(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const Image& target,
                                     std::uint32_t layer)
{
    const MaskLabel label(device_, commands, "mask layer", layer);
    marks_.begin(device_, commands, target, layer, hasDraws(plan, layer, DrawnAs::whole));
    std::uint32_t i = 0;
    for (const pack::MaskDraw& draw : now_.draws) {
        if (draw.layer != layer || !beginsAs(plan, draw, DrawnAs::settled)) {
            continue;
        }
        for (const DrawnAs as : {DrawnAs::settled, DrawnAs::left}) {
            const VkViewport viewport = MaskMarks::viewport(target.info().extent, i, as == DrawnAs::left);
            device_.vk.CmdSetViewport(commands, 0, 1, &viewport);
            recordDraw(commands, plan, slot, draw, as);
        }
        ++i;
    }
    device_.vk.CmdEndRendering(commands);
}

void MaskPassRecorder::recordLayer(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const Image& target,
                                   std::uint32_t layer, DrawnAs as)
{
    const MaskLabel label(device_, commands, as == DrawnAs::half ? "half mask layer" : "mask layer", layer);
    const VkExtent2D extent = target.info().extent;
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR; // undrawn pixels are lit
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color = {{1.0F, 1.0F, 1.0F, 1.0F}};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    device_.vk.CmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    device_.vk.CmdSetViewport(commands, 0, 1, &viewport);
    recordDraws(commands, plan, slot, layer, as, as);
    device_.vk.CmdEndRendering(commands);
}

/// Layers that recordHalved() begins are left to it.
void MaskPassRecorder::recordLayers(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const Image& target)
{
    toAttachment(device_, commands, target);
    for (std::uint32_t layer = 0; layer < target.info().layers; ++layer) {
        const bool settles = hasDraws(plan, layer, DrawnAs::settled);
        if (hasDraws(plan, layer, DrawnAs::whole) || !(settles || hasDraws(plan, layer, DrawnAs::half))) {
            recordLayer(commands, plan, slot, target, layer, DrawnAs::whole);
        }
        if (settles) {
            recordSettled(commands, plan, slot, target, layer);
        }
    }
}

void MaskPassRecorder::recordHalved(VkCommandBuffer commands, std::uint32_t slot_index, const Plan& plan,
                                    const MaskInputs& inputs, const Image& target)
{
    const Slot& slot = slots_[slot_index];
    const Image& half = spread_->half();
    const std::uint32_t layers = target.info().layers;
    toAttachment(device_, commands, half);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        if (hasDraws(plan, layer, DrawnAs::half)) {
            recordLayer(commands, plan, slot, half, layer, DrawnAs::half);
        }
    }
    toReadable(device_, commands, half);
    spread_->begin(slot_index, {inputs.depth, inputs.depth_layout, inputs.normal, inputs.object_id, no_numbers_.layer(),
                                slot.constants.buffer()});
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        if (!hasDraws(plan, layer, DrawnAs::half)) {
            continue;
        }
        pack::ScreenBounds area;
        for (const pack::MaskDraw& draw : now_.draws) {
            if (draw.layer == layer && beginsAs(plan, draw, DrawnAs::half)) {
                grow(area, draw.pixels);
            }
        }
        device_.beginLabel(commands, "mask spread");
        marks_.begin(device_, commands, target, layer,
                     hasDraws(plan, layer, DrawnAs::whole) || hasDraws(plan, layer, DrawnAs::settled));
        spread_->spread(commands, target, layer, rectOf(area));
        recordDraws(commands, plan, slot, layer, DrawnAs::half, DrawnAs::left);
        device_.vk.CmdEndRendering(commands);
        device_.endLabel(commands);
    }
}

} // namespace gnomon::vulkan
