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
    makeLayouts();
    makeSlots();
}

bool MaskPassRecorder::prepare(const Plan& plan, VkExtent2D screen)
{
    const std::uint32_t layers = std::max(plan.mask_layers, 1U);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const std::uint32_t views = describeMaskLayer(plan, layer).further_views;
        constexpr std::uint32_t kMost = shared::kViewsPerLayer - shared::kLightsPerLayer;
        if (views > kMost) {
            throw Error("prepare the shadow mask",
                        "four lights of one layer have " + std::to_string(views) + " views beyond their first; " +
                            std::to_string(kMost) + " are possible",
                        "use fewer views a light");
        }
    }
    const VkFormat format = maskFormat(plan);
    const ImageInfo& have = mask_.info();
    if (mask_ && have.format == format && have.layers >= layers && have.extent.width == screen.width &&
        have.extent.height == screen.height) {
        return false;
    }
    if (!mask_ || have.format != format) {
        pipelines_ = {};
    }
    mask_ = {};
    mask_ = Image(device_,
                  {format, screen, layers,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                   VK_IMAGE_ASPECT_COLOR_BIT, "mask"});
    for (Slot& slot : slots_) {
        if (slot.constants.size() < constants_stride_ * layers) {
            slot.constants = {};
            slot.constants =
                HostBuffer(device_, constants_stride_ * layers, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "constants");
            const VkDescriptorBufferInfo buffer{slot.constants.buffer(), 0, sizeof(shared::GpuMaskLayer)};
            VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
            write.dstSet = slot.set;
            write.descriptorCount = 1;
            write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
            write.pBufferInfo = &buffer;
            device_.vk.UpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
        }
    }
    return true;
}

void MaskPassRecorder::forgetMaps()
{
    for (Slot& slot : slots_) {
        slot.maps = VK_NULL_HANDLE;
        slot.layers = VK_NULL_HANDLE;
    }
}

void MaskPassRecorder::toAttachment(VkCommandBuffer commands)
{
    ImageBarrier barrier;
    barrier.image = mask_.image();
    barrier.layer_count = mask_.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_UNDEFINED; // every pixel is written
    barrier.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.source_stages = kReaders;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device_, commands, barrier);
}

void MaskPassRecorder::toReadable(VkCommandBuffer commands)
{
    ImageBarrier barrier;
    barrier.image = mask_.image();
    barrier.layer_count = mask_.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = kReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT;
    recordBarrier(device_, commands, barrier);
}

void MaskPassRecorder::recordLayer(VkCommandBuffer commands, const Slot& slot, std::uint32_t layer, VkPipeline pipeline)
{
    char label[32];
    std::snprintf(label, sizeof label, "mask layer %u", layer);
    device_.beginLabel(commands, label);
    const VkExtent2D extent = mask_.info().extent;
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = mask_.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    device_.vk.CmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    device_.vk.CmdSetViewport(commands, 0, 1, &viewport);
    device_.vk.CmdSetScissor(commands, 0, 1, &info.renderArea);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    const auto offset = static_cast<std::uint32_t>(constants_stride_ * layer);
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &slot.set, 1,
                                     &offset);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void MaskPassRecorder::record(VkCommandBuffer commands, std::uint32_t slot_index, const Frame& frame, const Plan& plan,
                              const MaskInputs& inputs, const Image& maps, const LayerPlacer& placer)
{
    assert(slot_index < slots_.size());
    assert(frame.lights.size() == plan.lights.size());
    assert(inputs.depth != VK_NULL_HANDLE);
    assert(inputs.extent.width == mask_.info().extent.width && inputs.extent.height == mask_.info().extent.height);
    Slot& slot = slots_[slot_index];
    updateSet(slot, inputs, maps.view(), placer.buffer());
    const MaskSurroundings around{options_.filter,    quantum_,           inputs.extent,
                                  maps.info().extent, maps.info().levels, placer};
    toAttachment(commands);
    for (std::uint32_t layer = 0; layer < mask_.info().layers; ++layer) {
        auto* constants = static_cast<std::byte*>(slot.constants.data()) + constants_stride_ * layer;
        fillMaskLayer(frame, plan, layer, around, *reinterpret_cast<shared::GpuMaskLayer*>(constants));
        const MaskLayerShape shape = describeMaskLayer(plan, layer);
        Variant variant;
        variant.lights = std::max(shape.lights, 1U);
        variant.many_views = shape.further_views > 0;
        variant.orthographic = shape.orthographic;
        variant.normals = inputs.normal != VK_NULL_HANDLE;
        variant.ids = inputs.object_id != VK_NULL_HANDLE;
        recordLayer(commands, slot, layer, pipeline(variant));
    }
    toReadable(commands);
}

} // namespace gnomon::vulkan
