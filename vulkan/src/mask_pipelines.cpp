// SPDX-License-Identifier: Apache-2.0
// The mask pass's layouts, descriptor sets and pipelines.
#include "graphics_pipeline.h"
#include "map_storage.h"
#include "mask_constants.h"
#include "mask_pass.h"
#include "moment_rule_of.h"
#include "samplers.h"

#include <array>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kConstants, kMaps, kDepth, kNormal, kObjectId, kLayers, kBindingCount };

// The constant_ids of mask_fragment.glsl, four bytes each, in their order.
struct Specialisation {
    std::int32_t filter;
    std::int32_t kernel_width;
    std::int32_t disc_taps;
    VkBool32 has_normals;
    std::int32_t lights;
    VkBool32 many_views;
    VkBool32 automatic_bias;
    std::int32_t moment_flags;
    std::int32_t moment_sampling;
    std::int32_t moment_layers;
    std::int32_t depth_holding;
    std::int32_t steps;
};

VkDescriptorType typeOf(std::uint32_t binding)
{
    switch (binding) {
    case kConstants:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    case kLayers:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    default:
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
}

VkWriteDescriptorSet imageWrite(VkDescriptorSet set, Binding binding, const VkDescriptorImageInfo& image)
{
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    return write;
}

} // namespace

void MaskPassRecorder::makeLayouts()
{
    std::array<VkDescriptorSetLayoutBinding, kBindingCount> bindings{};
    for (std::uint32_t i = 0; i < kBindingCount; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = typeOf(i);
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    }
    const VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0,
                                                   kBindingCount, bindings.data()};
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &set_layout),
          "create a descriptor set layout");
    set_layout_ = {device_, set_layout};

    VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set_layout;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device_.vk.CreatePipelineLayout(device_.handle(), &layout_info, nullptr, &layout),
          "create a pipeline layout");
    layout_ = {device_, layout};

    sampler_ = makeSampler(device_, VK_FILTER_NEAREST);
    // Depths must not be averaged, and filtering them is not a feature that formats of depth need have.
    map_sampler_ = makeSampler(device_, isFilterable(options_.filter.filter) ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
}

void MaskPassRecorder::makeSlots()
{
    const std::uint32_t count = options_.frames_in_flight;
    const std::array<VkDescriptorPoolSize, 3> sizes{
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, count},
         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count},
         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * (kBindingCount - 2)}}};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = count;
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorPool(device_.handle(), &pool_info, nullptr, &pool), "create a descriptor pool");
    pool_ = {device_, pool};

    slots_.resize(count);
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    for (Slot& slot : slots_) {
        const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1,
                                               &set_layout};
        check(device_.vk.AllocateDescriptorSets(device_.handle(), &info, &slot.set), "allocate a descriptor set");
        device_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleBits(slot.set), "mask");
    }
}

void MaskPassRecorder::updateSet(Slot& slot, const MaskInputs& inputs, VkImageView maps, VkBuffer layers)
{
    if (slot.maps == maps && slot.layers == layers && slot.depth == inputs.depth &&
        slot.depth_layout == inputs.depth_layout && slot.normal == inputs.normal &&
        slot.object_id == inputs.object_id) {
        return;
    }
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = sampler_.get();
    const VkDescriptorImageInfo map_image{map_sampler_.get(), maps, kRead};
    const VkDescriptorImageInfo depth_image{sampler, inputs.depth, inputs.depth_layout};
    // The shaders name the normals whether they read them or not, and lavapipe 22.3 crashes on a descriptor that was
    // never written even if no shader names it; so what is absent is filled with the depth.
    const auto orDepth = [&](VkImageView view) {
        return view != VK_NULL_HANDLE ? VkDescriptorImageInfo{sampler, view, kRead} : depth_image;
    };
    const VkDescriptorImageInfo normal_image = orDepth(inputs.normal);
    const VkDescriptorImageInfo id_image = orDepth(inputs.object_id);
    const VkDescriptorBufferInfo layer_buffer{layers, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet layer_write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    layer_write.dstSet = slot.set;
    layer_write.dstBinding = kLayers;
    layer_write.descriptorCount = 1;
    layer_write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    layer_write.pBufferInfo = &layer_buffer;
    const std::array<VkWriteDescriptorSet, 5> writes{
        imageWrite(slot.set, kMaps, map_image), imageWrite(slot.set, kDepth, depth_image),
        imageWrite(slot.set, kNormal, normal_image), imageWrite(slot.set, kObjectId, id_image), layer_write};
    device_.vk.UpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                    nullptr);
    slot.maps = maps;
    slot.layers = layers;
    slot.depth = inputs.depth;
    slot.depth_layout = inputs.depth_layout;
    slot.normal = inputs.normal;
    slot.object_id = inputs.object_id;
}

VkPipeline MaskPassRecorder::pipeline(Variant variant)
{
    Pipeline& pipeline = pipelines_[variant.index()];
    if (!pipeline) {
        pipeline = makePipeline(variant);
    }
    return pipeline.get();
}

Pipeline MaskPassRecorder::makePipeline(Variant variant)
{
    const FilterOptions& filter = options_.filter;
    const shared::MomentRule moments = isFilterable(filter.filter) ? momentRuleOf(filter) : shared::MomentRule{};
    const Specialisation values{static_cast<std::int32_t>(filter.filter),
                                kernelWidth(filter),
                                static_cast<std::int32_t>(filter.disc_taps),
                                variant.normals ? VK_TRUE : VK_FALSE,
                                static_cast<std::int32_t>(variant.lights),
                                variant.many_views ? VK_TRUE : VK_FALSE,
                                filter.bias.automatic ? VK_TRUE : VK_FALSE,
                                moments.flags,
                                moments.sampling,
                                moments.layers,
                                depthHolding(filter.filter, filter.format),
                                static_cast<std::int32_t>(variant.paired)};
    std::array<VkSpecializationMapEntry, sizeof values / 4> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        entries[i] = {i, 4 * i, 4};
    }
    const VkSpecializationInfo specialisation{static_cast<std::uint32_t>(entries.size()), entries.data(), sizeof values,
                                              &values};
    const std::size_t fragment =
        (variant.orthographic ? 1U : 0U) + (variant.ids ? 2U : 0U) + (variant.paired != 0 ? 4U : 0U);
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex_.get();
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragments_[fragment].get();
    stages[1].pSpecializationInfo = &specialisation;

    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = mask_.info().format;
    state.cache = options_.pipeline_cache;
    state.name = "mask";
    return makeGraphicsPipeline(device_, state);
}

} // namespace gnomon::vulkan
