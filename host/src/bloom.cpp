// SPDX-License-Identifier: Apache-2.0
#include "bloom.h"

#include "pipelines.h"
#include "shaders.h"

#include <algorithm>
#include <array>
#include <bit>

namespace gnomon::host {
namespace {

constexpr std::uint32_t kGroup = 8; // the group of the shaders, on each side

// Read by the passes that follow, and added to by some.
constexpr Access kLevelWrite{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                             VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                             VK_IMAGE_LAYOUT_GENERAL};
constexpr Access kLevelRead{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                            VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                            VK_IMAGE_LAYOUT_GENERAL};

std::uint32_t half(std::uint32_t size)
{
    return (size + 1) / 2;
}

} // namespace

std::uint32_t bloomLevels(VkExtent2D shown, std::uint32_t wanted)
{
    std::uint32_t count = 1;
    for (std::uint32_t side = half(std::min(shown.width, shown.height)); count < wanted && side >= 4; ++count) {
        side = half(side);
    }
    return count;
}

Bloom::Bloom(const Gpu& gpu, Memory& memory, const BloomOptions& options, const Image& light, VkExtent2D shown,
             bool average_four, VkSampler linear)
    : gpu_(gpu), names_(memory.names())
{
    makeImages(memory, shown, bloomLevels(shown, options.levels));
    makeLayouts();
    makeSteps(options, light, average_four, linear);
}

void Bloom::makeImages(Memory& memory, VkExtent2D shown, std::uint32_t count)
{
    VkExtent2D extent = shown;
    for (std::uint32_t i = 0; i < count; ++i) {
        extent = {half(extent.width), half(extent.height)};
        ImageWish wish;
        wish.name = "bloom";
        wish.purpose = "bloom";
        wish.format = kLightFormat;
        wish.extent = extent;
        wish.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        levels_.push_back(memory.image(wish));
    }
}

void Bloom::makeLayouts()
{
    VkDevice device = gpu_.view().device;
    const auto sets = static_cast<std::uint32_t>(levels_.size() * 2 - 1);
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sets}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, sets}}};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = sets;
    pool_info.poolSizeCount = sizes.size();
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "making a descriptor pool");
    pool_ = {gpu_, pool};
    const std::array<VkDescriptorSetLayoutBinding, 2> bindings{
        {{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
         {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}}};
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.bindingCount = bindings.size();
    set.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device, &set, nullptr, &set_layout), "making a descriptor set layout");
    set_layout_ = {gpu_, set_layout};
    VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set_layout;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout), "making a pipeline layout");
    layout_ = {gpu_, layout};
    names_.name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "bloom");
    names_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_layout, "bloom");
    names_.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout, "bloom");
}

void Bloom::makeSteps(const BloomOptions& options, const Image& light, bool average_four, VkSampler linear)
{
    const auto bits = [](float value) {
        return std::bit_cast<std::uint32_t>(value);
    };
    const std::array<std::uint32_t, 3> first{average_four ? VK_TRUE : VK_FALSE, bits(options.threshold),
                                             bits(options.knee)};
    const std::array<std::uint32_t, 1> up{bits(options.radius)};
    steps_.push_back({makePipeline("bloom first", "bloom_first.comp", first),
                      makeSet(light.view, kSampledByAll.layout, linear, levels_[0].view), 0, false});
    if (levels_.size() == 1) {
        return;
    }
    VkPipeline halve = makePipeline("bloom down", "bloom_down.comp", {});
    for (std::size_t i = 1; i < levels_.size(); ++i) {
        steps_.push_back({halve, makeSet(levels_[i - 1].view, kLevelRead.layout, linear, levels_[i].view), i, false});
    }
    VkPipeline enlarge = makePipeline("bloom up", "bloom_up.comp", up);
    for (std::size_t i = levels_.size() - 1; i-- > 0;) {
        steps_.push_back({enlarge, makeSet(levels_[i + 1].view, kLevelRead.layout, linear, levels_[i].view), i, true});
    }
}

VkPipeline Bloom::makePipeline(const char* name, std::string_view shader, std::span<const std::uint32_t> constants)
{
    const std::span<const std::uint32_t> words = shaderWords(gpu_.view().shaders, shader);
    VkDevice device = gpu_.view().device;
    VkShaderModuleCreateInfo module{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module.codeSize = words.size_bytes();
    module.pCode = words.data();
    const std::array<VkSpecializationMapEntry, 3> entries{{{0, 0, 4}, {1, 4, 4}, {2, 8, 4}}};
    const VkSpecializationInfo special{static_cast<std::uint32_t>(constants.size()), entries.data(),
                                       constants.size_bytes(), constants.data()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.layout = layout_.get();
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &special;
    check(vkCreateShaderModule(device, &module, nullptr, &info.stage.module), "making a shader");
    const OwnedShader owned(gpu_, info.stage.module);
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device, gpu_.pipelineCache(), 1, &info, nullptr, &pipeline), "compiling shaders");
    pipelines_.push_back(OwnedPipeline(gpu_, pipeline));
    names_.name(VK_OBJECT_TYPE_PIPELINE, pipeline, name);
    return pipeline;
}

VkDescriptorSet Bloom::makeSet(VkImageView source, VkImageLayout layout, VkSampler sampler, VkImageView target)
{
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = 1;
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    info.pSetLayouts = &set_layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(gpu_.view().device, &info, &set), "making a descriptor set");
    names_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set, "bloom");
    const std::array<VkDescriptorImageInfo, 2> images{
        {{sampler, source, layout}, {VK_NULL_HANDLE, target, VK_IMAGE_LAYOUT_GENERAL}}};
    std::array<VkWriteDescriptorSet, 2> writes{};
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType =
            i == 0 ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        writes[i].pImageInfo = &images[i];
    }
    vkUpdateDescriptorSets(gpu_.view().device, writes.size(), writes.data(), 0, nullptr);
    return set;
}

void Bloom::record(VkCommandBuffer commands) const
{
    for (const Image& level : levels_) {
        barrier(commands, level, discardAfter(kSampledByAll), kLevelWrite);
    }
    VkPipeline bound = VK_NULL_HANDLE;
    for (const Step& step : steps_) {
        if (step.pipeline != bound) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, step.pipeline);
            bound = step.pipeline;
        }
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &step.set, 0, nullptr);
        if (step.adds) {
            barrier(commands, levels_[step.target], kLevelRead, kLevelWrite); // it has been read to be halved
        }
        const VkExtent2D extent = levels_[step.target].extent;
        vkCmdDispatch(commands, (extent.width + kGroup - 1) / kGroup, (extent.height + kGroup - 1) / kGroup, 1);
        const bool last = &step == &steps_.back();
        barrier(commands, levels_[step.target], kLevelWrite, last ? kSampled : kLevelRead);
    }
}

} // namespace gnomon::host
