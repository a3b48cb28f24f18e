// SPDX-License-Identifier: Apache-2.0
// The layouts, pipelines and descriptor sets of the passes that fit cascades.
#include "cascade_fitter.h"

#include <gnomon_spirv.h>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kLights, kKeys, kViews, kReport, kDepths, kObjectIds, kBindingCount };
constexpr std::uint32_t kBuffers = kDepths;
constexpr std::uint32_t kCompleteBuffers = 2; // cascade_constants.comp

SetLayout makeSetLayout(Device& device, std::uint32_t buffers, std::uint32_t images)
{
    std::array<VkDescriptorSetLayoutBinding, kBindingCount> bindings{};
    for (std::uint32_t i = 0; i < buffers + images; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = i < buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    const VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0,
                                               buffers + images, bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(device.vk.CreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
          "create a descriptor set layout");
    return {device, layout};
}

PipelineLayout makeLayout(Device& device, VkDescriptorSetLayout set_layout, std::uint32_t push_bytes)
{
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    const VkPipelineLayoutCreateInfo info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set_layout, push_bytes > 0 ? 1U : 0U, &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device.vk.CreatePipelineLayout(device.handle(), &info, nullptr, &layout), "create a pipeline layout");
    return {device, layout};
}

Pipeline makePipeline(Device& device, std::span<const std::uint32_t> spirv, VkPipelineLayout layout,
                      VkPipelineCache cache)
{
    const ShaderModule module = makeShader(device, spirv);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device.vk.CreateComputePipelines(device.handle(), cache, 1, &info, nullptr, &pipeline),
          "create a pipeline that fits cascades");
    return {device, pipeline};
}

} // namespace

void CascadeFitter::makePipelines()
{
    fit_set_layout_ = makeSetLayout(device_, kBuffers, kBindingCount - kBuffers);
    complete_set_layout_ = makeSetLayout(device_, kCompleteBuffers, 0);
    fit_layout_ = makeLayout(device_, fit_set_layout_.get(), 0);
    complete_layout_ = makeLayout(device_, complete_set_layout_.get(), sizeof(std::uint32_t));
    const std::array<std::span<const std::uint32_t>, kPassCount> code{
        spirv::cascade_depth_comp, spirv::cascade_depth_ids_comp, spirv::cascade_bounds_comp,
        spirv::cascade_bounds_ids_comp, spirv::cascade_finish_comp};
    for (std::uint32_t i = 0; i < kPassCount; ++i) {
        passes_[i] = makePipeline(device_, code[i], fit_layout_.get(), cache_);
    }
    complete_ = makePipeline(device_, spirv::cascade_constants_comp, complete_layout_.get(), cache_);
}

void CascadeFitter::makeSets()
{
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, slot_count_ * (kBuffers + kCompleteBuffers)},
         {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, slot_count_ * (kBindingCount - kBuffers)}}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = 2 * slot_count_;
    info.poolSizeCount = sizes.size();
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorPool(device_.handle(), &info, nullptr, &pool), "create a descriptor pool");
    pool_ = {device_, pool};
    const auto allocate = [&](const SetLayout& set_layout, VkDescriptorSet& set, const char* name) {
        const VkDescriptorSetLayout layout = set_layout.get();
        const VkDescriptorSetAllocateInfo wish{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1,
                                               &layout};
        check(device_.vk.AllocateDescriptorSets(device_.handle(), &wish, &set), "allocate a descriptor set");
        device_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleBits(set), name);
    };
    slots_.resize(slot_count_);
    for (Slot& slot : slots_) {
        allocate(fit_set_layout_, slot.fit, "cascade bounds");
        allocate(complete_set_layout_, slot.complete, "cascade constants");
    }
}

void CascadeFitter::updateFitSet(Slot& slot, const MaskInputs& inputs)
{
    if (slot.depth == inputs.depth && slot.depth_layout == inputs.depth_layout && slot.object_id == inputs.object_id) {
        return;
    }
    const std::array<VkDescriptorBufferInfo, kBuffers> buffers{{{slot.lights.buffer(), 0, VK_WHOLE_SIZE},
                                                                {keys_.buffer(), 0, VK_WHOLE_SIZE},
                                                                {views_.buffer(), 0, VK_WHOLE_SIZE},
                                                                {slot.report.buffer(), 0, VK_WHOLE_SIZE}}};
    const VkDescriptorImageInfo depth{VK_NULL_HANDLE, inputs.depth, inputs.depth_layout};
    const VkDescriptorImageInfo ids{VK_NULL_HANDLE, inputs.object_id, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    // No shader reads ids that are not given; but a descriptor that was never written crashes lavapipe 22.3.
    const std::array<VkDescriptorImageInfo, 2> images{depth, inputs.object_id != VK_NULL_HANDLE ? ids : depth};
    std::array<VkWriteDescriptorSet, 2> writes{};
    for (VkWriteDescriptorSet& write : writes) {
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = slot.fit;
    }
    writes[0].dstBinding = kLights;
    writes[0].descriptorCount = buffers.size();
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[0].pBufferInfo = buffers.data();
    writes[1].dstBinding = kDepths;
    writes[1].descriptorCount = images.size();
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    writes[1].pImageInfo = images.data();
    device_.vk.UpdateDescriptorSets(device_.handle(), writes.size(), writes.data(), 0, nullptr);
    slot.depth = inputs.depth;
    slot.depth_layout = inputs.depth_layout;
    slot.object_id = inputs.object_id;
}

} // namespace gnomon::vulkan
