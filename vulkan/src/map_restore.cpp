// SPDX-License-Identifier: Apache-2.0
#include "map_restore.h"

#include "graphics_pipeline.h"
#include "samplers.h"

#include <gnomon_spirv.h>

namespace gnomon::vulkan {
namespace {

using Layer = std::int32_t; // push constant of restore_fragment.glsl

} // namespace

MapRestorer::MapRestorer(Device& device, const MapStorage& storage, VkPipelineCache cache)
    : device_(device), storage_(storage), cache_(cache)
{
    sampler_ = makeSampler(device, VK_FILTER_NEAREST);
    makeLayouts();
    makeSet();
}

void MapRestorer::makeLayouts()
{
    std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &set_layout),
          "create a descriptor set layout");
    set_layout_ = {device_, set_layout};
    const VkPushConstantRange range{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(Layer)};
    const VkPipelineLayoutCreateInfo info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set_layout, 1, &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device_.vk.CreatePipelineLayout(device_.handle(), &info, nullptr, &layout), "create a pipeline layout");
    layout_ = {device_, layout};
}

void MapRestorer::makeSet()
{
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorPool(device_.handle(), &pool_info, nullptr, &pool), "create a descriptor pool");
    pool_ = {device_, pool};
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1,
                                           &set_layout};
    check(device_.vk.AllocateDescriptorSets(device_.handle(), &info, &set_), "allocate a descriptor set");
    device_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleBits(set_), "restore");
}

void MapRestorer::setKept(VkImageView depths, VkImageView colours)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    // Lavapipe 22.3 crashes on a descriptor that was never written even if no shader names it.
    const std::array<VkDescriptorImageInfo, 2> images{
        {{sampler_.get(), depths, kRead}, {sampler_.get(), colours != VK_NULL_HANDLE ? colours : depths, kRead}}};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.descriptorCount = 1;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        write.dstBinding = i;
        write.pImageInfo = &images[i];
        device_.vk.UpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    }
}

Pipeline MapRestorer::makePipeline(std::span<const std::uint32_t> fragment, TexelPart part)
{
    const ShaderModule vertex_module = makeShader(device_, spirv::restore_vert);
    const ShaderModule fragment_module = makeShader(device_, fragment);
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex_module.get();
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragment_module.get();
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = storage_.colour;
    state.colour_mask = colourMaskOf(storage_.colour, part);
    state.depth_format = storage_.depth;
    state.cache = cache_;
    state.name = "restore";
    return makeGraphicsPipeline(device_, state);
}

void MapRestorer::restore(VkCommandBuffer commands, TexelPart part, std::uint32_t layer)
{
    Pipeline& pipeline = restores_[static_cast<std::size_t>(part)];
    if (!pipeline) {
        pipeline = makePipeline(storage_.depthOnly() ? spirv::restore_depth_frag : spirv::restore_colour_frag, part);
    }
    const auto push = static_cast<Layer>(layer);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set_, 0, nullptr);
    device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push, &push);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

void MapRestorer::clear(VkCommandBuffer commands, TexelPart part)
{
    Pipeline& pipeline = clears_[static_cast<std::size_t>(part)];
    if (!pipeline) {
        pipeline = makePipeline(spirv::restore_clear_frag, part);
    }
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

} // namespace gnomon::vulkan
