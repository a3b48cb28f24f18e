// SPDX-License-Identifier: Apache-2.0
#include "mask_pass.h"

#include "barriers.h"

#include <gnomon_spirv.h>

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstring>

namespace gnomon::vulkan {
namespace {

// Who may read the mask after us, and so who must be done before the next frame writes it.
constexpr VkPipelineStageFlags2 kReaders = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;

// To be drawn to. Every pixel is written.
void toAttachment(const Device& device, VkCommandBuffer commands, const Image& image)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.source_stages = kReaders;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, commands, barrier);
}

void toReadable(const Device& device, VkCommandBuffer commands, const Image& image)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = kReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT;
    recordBarrier(device, commands, barrier);
}

// Whether the motion, which does not change from frame to frame, may part the screen.
bool mayHaveBands(const Plan& plan)
{
    return plan.technique.motion == Motion::step_band ||
           std::any_of(plan.lights.begin(), plan.lights.end(),
                       [](const LightPlan& light) { return light.steps.band > 0.0; });
}

VkFormat maskFormat(const Plan& plan)
{
    return plan.lights.size() <= 1 ? VK_FORMAT_R8_UNORM : VK_FORMAT_R8G8B8A8_UNORM;
}

} // namespace

MaskPassRecorder::MaskPassRecorder(Device& device, const ShadowRendererOptions& options, float quantum)
    : device_(device), options_(options), quantum_(quantum), vertex_(makeShader(device, spirv::mask_numbers_vert))
{
    makeLayouts();
    makeSlots();
}

void MaskPassRecorder::makeBuffers(const Plan& plan)
{
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const VkDeviceSize align =
        std::max<VkDeviceSize>({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, 16});
    const auto aligned = [&](VkDeviceSize bytes) {
        return (bytes + align - 1) / align * align;
    };
    const std::uint32_t lights = maskLightCount(std::max(plan.mask_layers, 1U), mayHaveBands(plan));
    const auto views = static_cast<std::uint32_t>(std::max<std::size_t>(plan.views.size(), shared::kFewViews));
    if (lights <= room_.lights && views <= room_.views) {
        return;
    }
    room_.lights = std::max(room_.lights, lights);
    room_.views = std::max(room_.views, views);
    room_.lights_at = aligned(sizeof(shared::GpuConstants));
    room_.views_at = room_.lights_at + aligned(room_.lights * sizeof(shared::GpuLight));
    const VkDeviceSize bytes = room_.views_at + room_.views * sizeof(shared::GpuView);
    for (Slot& slot : slots_) {
        device_.retire(std::move(slot.constants));
        slot.constants = HostBuffer(
            device_, bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "constants");
    }
    draws_.reserve(lights);
}

bool MaskPassRecorder::prepare(const Plan& plan, VkExtent2D screen)
{
    const std::uint32_t layers = std::max(plan.mask_layers, 1U);
    makeBuffers(plan);
    const VkFormat format = maskFormat(plan);
    const ImageInfo& have = mask_.info();
    const bool fits = mask_ && have.format == format && have.layers >= layers && have.extent.width == screen.width &&
                      have.extent.height == screen.height;
    if (!fits) {
        if (!mask_ || have.format != format) {
            for (Pipeline& pipeline : pipelines_) {
                device_.retire(std::move(pipeline));
            }
        }
        device_.retire(std::move(mask_));
        mask_ = Image(device_, {format, screen, layers,
                                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                VK_IMAGE_ASPECT_COLOR_BIT, "mask"});
    }
    shape_ = shape_ ? shape_ : options_.mask_shape;
    if (shape_) {
        makePipelines(plan, *shape_);
    }
    if (plan.technique.motion == Motion::step_alternate || alternates(plan)) {
        if (!alternate_) {
            alternate_.emplace(device_, static_cast<std::uint32_t>(slots_.size()), options_.pipeline_cache);
        }
        alternate_->prepare(mask_.info(), plan.lights.size());
    }
    return !fits;
}

void MaskPassRecorder::fill(Slot& slot, const Frame& frame, const Plan& plan, const MaskSurroundings& around)
{
    auto* const bytes = static_cast<std::byte*>(slot.constants.data());
    fillMaskConstants(frame, plan, around, *reinterpret_cast<shared::GpuConstants*>(bytes));
    fillMaskLights(frame, plan, around.screen.width,
                   {reinterpret_cast<shared::GpuLight*>(bytes + room_.lights_at), room_.lights}, draws_);
    fillMaskViews(frame, plan, around, {reinterpret_cast<shared::GpuView*>(bytes + room_.views_at), room_.views});
}

void MaskPassRecorder::recordDraw(VkCommandBuffer commands, const MaskDraw& draw, const MaskInputs& inputs)
{
    const VkRect2D scissor{{static_cast<std::int32_t>(draw.begin), 0}, {draw.end - draw.begin, inputs.extent.height}};
    device_.vk.CmdSetScissor(commands, 0, 1, &scissor);
    const Variant variant{draw.orthographic, inputs.normal != VK_NULL_HANDLE, inputs.object_id != VK_NULL_HANDLE,
                          draw.few_views};
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline(variant));
    const MaskPush push{draw.first_light, draw.channels};
    device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push, &push);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

void MaskPassRecorder::recordLayer(VkCommandBuffer commands, const MaskInputs& inputs, const Image& target,
                                   std::uint32_t layer)
{
    char label[32];
    std::snprintf(label, sizeof label, "mask layer %u", layer);
    device_.beginLabel(commands, label);
    const VkExtent2D extent = target.info().extent;
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR; // a layer beyond the plan's lights is lit
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
    for (const MaskDraw& draw : draws_) {
        if (draw.layer == layer) {
            recordDraw(commands, draw, inputs);
        }
    }
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void MaskPassRecorder::record(VkCommandBuffer commands, std::uint32_t slot_index, const Frame& frame, const Plan& plan,
                              const MaskInputs& inputs, const Image& maps, const LayerPlacer& placer,
                              CascadeFitter& fitter)
{
    assert(slot_index < slots_.size());
    assert(frame.lights.size() == plan.lights.size() && plan.views.size() <= room_.views);
    assert(inputs.depth != VK_NULL_HANDLE);
    assert(inputs.extent.width == mask_.info().extent.width && inputs.extent.height == mask_.info().extent.height);
    shape_ = MaskShape{inputs.normal != VK_NULL_HANDLE, inputs.object_id != VK_NULL_HANDLE};
    Slot& slot = slots_[slot_index];
    writeSet(slot, inputs, maps.view(), placer.buffer());
    fill(slot, frame, plan, {options_.filter, quantum_, inputs.extent, maps.info().extent, maps.info().levels, placer});
    if (CascadeFitter::fits(plan)) {
        fitter.recordConstants(commands, slot_index, slot.constants, room_.views_at,
                               static_cast<std::uint32_t>(plan.views.size()));
    }
    const bool joins = alternate_ && alternates(plan);
    const Image& target = joins ? alternate_->target() : mask_;
    toAttachment(device_, commands, target);
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &slot.set, 0,
                                     nullptr);
    for (std::uint32_t layer = 0; layer < target.info().layers; ++layer) {
        recordLayer(commands, inputs, target, layer);
    }
    toReadable(device_, commands, target);
    if (joins) {
        toAttachment(device_, commands, mask_);
        alternate_->record(commands, slot_index, frame, plan,
                           {inputs.depth, inputs.depth_layout, slot.constants.buffer()}, mask_);
        toReadable(device_, commands, mask_);
    } else if (alternate_) {
        alternate_->forget();
    }
}

} // namespace gnomon::vulkan
