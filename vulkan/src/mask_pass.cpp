// SPDX-License-Identifier: Apache-2.0
#include "mask_pass.h"

#include "mask_constants.h"

#include <gnomon/error.h>
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

void checkViews(const Plan& plan, std::uint32_t layer)
{
    const MaskLayerShape shape = describeMaskLayer(plan, layer, MaskRegion{});
    const std::uint32_t most = shared::kViewsPerLayer - firstViews(shape);
    if (shape.further_views > most) {
        throw Error("prepare the shadow mask",
                    "four lights of one layer have " + std::to_string(shape.further_views) +
                        " views beyond their first; " + std::to_string(most) + " are possible",
                    "use fewer views a light");
    }
}

VkFormat maskFormat(const Plan& plan)
{
    return plan.lights.size() <= 1 ? VK_FORMAT_R8_UNORM : VK_FORMAT_R8G8B8A8_UNORM;
}

} // namespace

MaskPassRecorder::MaskPassRecorder(Device& device, const ShadowRendererOptions& options, float quantum)
    : device_(device), options_(options), quantum_(quantum)
{
    const VkDeviceSize align = std::max<VkDeviceSize>(device.limits().minUniformBufferOffsetAlignment, 16);
    constants_stride_ = (sizeof(shared::GpuMaskLayer) + align - 1) / align * align;
    vertex_ = makeShader(device, spirv::mask_vert);
    fragments_[0] = makeShader(device, spirv::mask_frag);
    fragments_[1] = makeShader(device, spirv::mask_orthographic_frag);
    fragments_[2] = makeShader(device, spirv::mask_ids_frag);
    fragments_[3] = makeShader(device, spirv::mask_orthographic_ids_frag);
    fragments_[4] = makeShader(device, spirv::mask_stepping_frag);
    fragments_[5] = makeShader(device, spirv::mask_stepping_orthographic_frag);
    fragments_[6] = makeShader(device, spirv::mask_stepping_ids_frag);
    fragments_[7] = makeShader(device, spirv::mask_stepping_orthographic_ids_frag);
    makeLayouts();
    makeSlots();
}

void MaskPassRecorder::makeConstants(std::uint32_t layers, std::uint32_t regions)
{
    regions_ = std::max(regions_, regions);
    const VkDeviceSize bytes = constants_stride_ * layers * regions_;
    for (Slot& slot : slots_) {
        if (slot.constants.size() >= bytes) {
            continue;
        }
        slot.constants = {};
        slot.constants = HostBuffer(
            device_, bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "constants");
        writeConstants(slot);
    }
}

bool MaskPassRecorder::prepare(const Plan& plan, VkExtent2D screen)
{
    const std::uint32_t layers = std::max(plan.mask_layers, 1U);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        checkViews(plan, layer);
    }
    makeConstants(layers, mayHaveBands(plan) ? MaskRegions::kMost : 1U);
    const VkFormat format = maskFormat(plan);
    const ImageInfo& have = mask_.info();
    const bool fits = mask_ && have.format == format && have.layers >= layers && have.extent.width == screen.width &&
                      have.extent.height == screen.height;
    if (!fits) {
        if (!mask_ || have.format != format) {
            pipelines_ = {};
        }
        mask_ = {};
        mask_ = Image(device_, {format, screen, layers,
                                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                VK_IMAGE_ASPECT_COLOR_BIT, "mask"});
    }
    if (plan.technique.motion == Motion::step_alternate || alternates(plan)) {
        if (!alternate_) {
            alternate_.emplace(device_, static_cast<std::uint32_t>(slots_.size()), options_.pipeline_cache);
        }
        alternate_->prepare(mask_.info(), plan.lights.size());
    }
    return !fits;
}

void MaskPassRecorder::forgetMaps()
{
    for (Slot& slot : slots_) {
        slot.maps = VK_NULL_HANDLE;
        slot.layers = VK_NULL_HANDLE;
    }
}

void MaskPassRecorder::recordRegion(const Job& job, std::uint32_t layer, const MaskRegion& region, std::uint32_t place)
{
    const MaskSurroundings around{options_.filter,        quantum_,  job.inputs.extent, job.maps.info().extent,
                                  job.maps.info().levels, job.placer};
    const VkDeviceSize offset = constants_stride_ * place;
    auto* constants = static_cast<std::byte*>(job.slot.constants.data()) + offset;
    fillMaskLayer(job.frame, job.plan, layer, region, around, *reinterpret_cast<shared::GpuMaskLayer*>(constants));
    const MaskLayerShape shape = describeMaskLayer(job.plan, layer, region);
    Variant variant;
    variant.lights = std::max(shape.lights, 1U);
    variant.many_views = shape.further_views > 0;
    variant.orthographic = shape.orthographic;
    variant.normals = job.inputs.normal != VK_NULL_HANDLE;
    variant.ids = job.inputs.object_id != VK_NULL_HANDLE;
    variant.paired = shape.paired;
    const VkRect2D scissor{{static_cast<std::int32_t>(region.begin), 0},
                           {region.end - region.begin, job.inputs.extent.height}};
    device_.vk.CmdSetScissor(job.commands, 0, 1, &scissor);
    device_.vk.CmdBindPipeline(job.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline(variant));
    const auto dynamic_offset = static_cast<std::uint32_t>(offset);
    device_.vk.CmdBindDescriptorSets(job.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &job.slot.set,
                                     1, &dynamic_offset);
    device_.vk.CmdDraw(job.commands, 3, 1, 0, 0);
}

void MaskPassRecorder::recordLayer(const Job& job, const Image& target, std::uint32_t layer)
{
    char label[32];
    std::snprintf(label, sizeof label, "mask layer %u", layer);
    device_.beginLabel(job.commands, label);
    const VkExtent2D extent = target.info().extent;
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    device_.vk.CmdBeginRendering(job.commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    device_.vk.CmdSetViewport(job.commands, 0, 1, &viewport);
    std::uint32_t place = layer * regions_;
    const MaskRegions regions = maskRegions(job.plan, layer, extent.width);
    assert(regions.count <= regions_);
    for (const MaskRegion& region : regions) {
        recordRegion(job, layer, region, place++);
    }
    device_.vk.CmdEndRendering(job.commands);
    device_.endLabel(job.commands);
}

void MaskPassRecorder::record(VkCommandBuffer commands, std::uint32_t slot_index, const Frame& frame, const Plan& plan,
                              const MaskInputs& inputs, const Image& maps, const LayerPlacer& placer,
                              CascadeFitter& fitter)
{
    assert(slot_index < slots_.size());
    assert(frame.lights.size() == plan.lights.size());
    assert(inputs.depth != VK_NULL_HANDLE);
    assert(inputs.extent.width == mask_.info().extent.width && inputs.extent.height == mask_.info().extent.height);
    Slot& slot = slots_[slot_index];
    updateSet(slot, inputs, maps.view(), placer.buffer());
    if (CascadeFitter::fits(plan)) {
        // Filled in below, and read by the GPU long after. No band: these maps go with motion free alone.
        for (std::uint32_t layer = 0; layer < mask_.info().layers; ++layer) {
            fitter.recordConstants(commands, slot_index, slot.constants, constants_stride_ * layer * regions_);
        }
    }
    const Job job{commands, slot, frame, plan, inputs, maps, placer};
    const bool joins = alternate_ && alternates(plan);
    const Image& target = joins ? alternate_->target() : mask_;
    toAttachment(device_, commands, target);
    for (std::uint32_t layer = 0; layer < target.info().layers; ++layer) {
        recordLayer(job, target, layer);
    }
    toReadable(device_, commands, target);
    if (joins) {
        toAttachment(device_, commands, mask_);
        alternate_->record(commands, slot_index, frame, plan,
                           {inputs.depth, inputs.depth_layout, slot.constants.buffer(), constants_stride_ * regions_},
                           mask_);
        toReadable(device_, commands, mask_);
    } else if (alternate_) {
        alternate_->forget();
    }
}

} // namespace gnomon::vulkan
