// SPDX-License-Identifier: Apache-2.0
#include "filter_layout.h"

#include "graphics_pipeline.h"
#include "moment_rule_of.h"

#include <gnomon_spirv.h>

#include <gpu_structs.h>

#include <array>

namespace gnomon::vulkan {
namespace {

// What options allow and what shaders have room for.
static_assert(kMaxBlurRadius == shared::kMostBlurRadius && kMaxBlurRadius < shared::kBlockTexels);
static_assert(kMaxDepthLayers == shared::kDepthLayers && kMaxDepthLayers == 2 * shared::kMostImageLayers);

enum Binding : std::uint32_t { kSource, kTarget, kBlocks, kDepthLayers, kKernel, kCounts, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC};
constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

using Entries = std::array<VkSpecializationMapEntry, sizeof(FilterConstants) / 4>;

Entries makeEntries()
{
    Entries entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        entries[i] = {i, 4 * i, 4};
    }
    return entries;
}

} // namespace

FilterConstants filterConstants(const FilterOptions& filter)
{
    const shared::MomentRule rule = momentRuleOf(filter);
    FilterConstants constants;
    constants.filter = static_cast<std::int32_t>(filter.filter);
    constants.flags = rule.flags;
    constants.layers = rule.layers;
    constants.exponent = rule.exponent;
    constants.exponent_negative = rule.exponent_negative;
    constants.moment_bias = rule.moment_bias;
    constants.radius = static_cast<std::int32_t>(blurRadius(filter.moments));
    return constants;
}

FilterLayout::FilterLayout(Device& device, VkPipelineCache cache) : device_(device), cache_(cache)
{
    makeLayouts();
}

void FilterLayout::makeLayouts()
{
    std::array<VkDescriptorSetLayoutBinding, kBindingCount> bindings{};
    for (std::uint32_t i = 0; i < kBindingCount; ++i) {
        bindings[i] = {i, kTypes[i], 1, kStages, nullptr};
    }
    const VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0,
                                                   kBindingCount, bindings.data()};
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &set_layout),
          "create a descriptor set layout");
    set_layout_ = {device_, set_layout};
    const VkPushConstantRange range{kStages, 0, sizeof(shared::FilterPassPlace)};
    const VkPipelineLayoutCreateInfo layout_info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set_layout, 1, &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device_.vk.CreatePipelineLayout(device_.handle(), &layout_info, nullptr, &layout),
          "create a pipeline layout");
    layout_ = {device_, layout};
    nearest_ = makeSampler(VK_FILTER_NEAREST);
    linear_ = makeSampler(VK_FILTER_LINEAR);
}

Sampler FilterLayout::makeSampler(VkFilter filter)
{
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = filter;
    info.minFilter = filter;
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    check(device_.vk.CreateSampler(device_.handle(), &info, nullptr, &sampler), "create a sampler");
    return {device_, sampler};
}

void FilterLayout::reset(std::uint32_t sets)
{
    std::array<VkDescriptorPoolSize, kBindingCount> sizes{};
    for (std::uint32_t i = 0; i < kBindingCount; ++i) {
        sizes[i] = {kTypes[i], sets};
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorPool(device_.handle(), &info, nullptr, &pool), "create a descriptor pool");
    pool_ = {device_, pool};
}

VkDescriptorSet FilterLayout::makeSet(const FilterBindings& bindings)
{
    const VkDescriptorSetLayout layout = set_layout_.get();
    const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool_.get(), 1,
                                           &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(device_.vk.AllocateDescriptorSets(device_.handle(), &info, &set), "allocate a descriptor set");
    device_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleBits(set), "shadow filter");

    const std::array<VkDescriptorImageInfo, 2> images{
        bindings.source_is_depth
            ? VkDescriptorImageInfo{nearest_.get(), bindings.source, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}
            : VkDescriptorImageInfo{linear_.get(), bindings.source, VK_IMAGE_LAYOUT_GENERAL},
        VkDescriptorImageInfo{VK_NULL_HANDLE, bindings.target, VK_IMAGE_LAYOUT_GENERAL}};
    const std::array<VkDescriptorBufferInfo, 4> buffers{{{bindings.blocks, 0, VK_WHOLE_SIZE},
                                                         {bindings.depth_layers, 0, VK_WHOLE_SIZE},
                                                         {bindings.kernel, 0, sizeof(shared::BlurKernel)},
                                                         {bindings.counts, 0, sizeof(shared::BlurCounts)}}};
    std::array<VkWriteDescriptorSet, kBindingCount> writes{};
    for (std::uint32_t i = 0; i < kBindingCount; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = kTypes[i];
        writes[i].pImageInfo = i < kBlocks ? &images[i] : nullptr;
        writes[i].pBufferInfo = i < kBlocks ? nullptr : &buffers[i - kBlocks];
    }
    device_.vk.UpdateDescriptorSets(device_.handle(), kBindingCount, writes.data(), 0, nullptr);
    return set;
}

Pipeline FilterLayout::makeCompute(std::span<const std::uint32_t> spirv, const FilterConstants& constants,
                                   const char* name)
{
    const ShaderModule shader = makeShader(device_, spirv);
    const Entries entries = makeEntries();
    const VkSpecializationInfo specialisation{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              sizeof constants, &constants};
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = shader.get();
    create.stage.pName = "main";
    create.stage.pSpecializationInfo = &specialisation;
    create.layout = layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device_.vk.CreateComputePipelines(device_.handle(), cache_, 1, &create, nullptr, &pipeline),
          "create a compute pipeline");
    device_.name(VK_OBJECT_TYPE_PIPELINE, handleBits(pipeline), name);
    return {device_, pipeline};
}

Pipeline FilterLayout::makeFragment(std::span<const std::uint32_t> spirv, const FilterConstants& constants,
                                    VkFormat format, const char* name)
{
    const ShaderModule vertex = makeShader(device_, spirv::mask_vert);
    const ShaderModule fragment = makeShader(device_, spirv);
    const Entries entries = makeEntries();
    const VkSpecializationInfo specialisation{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              sizeof constants, &constants};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex.get();
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragment.get();
    stages[1].pSpecializationInfo = &specialisation;
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = format;
    state.cache = cache_;
    state.name = name;
    return makeGraphicsPipeline(device_, state);
}

void FilterLayout::bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline, VkDescriptorSet set,
                        std::uint32_t counts_offset, const shared::FilterPassPlace& place) const
{
    device_.vk.CmdBindPipeline(commands, point, pipeline);
    device_.vk.CmdBindDescriptorSets(commands, point, layout_.get(), 0, 1, &set, 1, &counts_offset);
    device_.vk.CmdPushConstants(commands, layout_.get(), kStages, 0, sizeof place, &place);
}

} // namespace gnomon::vulkan
