// SPDX-License-Identifier: Apache-2.0
#include "filter_layout.h"

#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"

#include <gnomon_spirv.h>

#include <gnomon/shared/gpu_structs.h>

#include <array>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kSource, kTarget, kBlocks, kDepthLayers, kKernel, kCounts, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC};
constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

} // namespace

FilterLayout::FilterLayout(Device& device, VkPipelineCache cache)
    : device_(device), cache_(cache), sets_(device, kTypes, kStages),
      layout_(makePipelineLayout(device, sets_.layout(), kStages, sizeof(shared::FilterPassPlace))),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)), linear_(makeSampler(device, VK_FILTER_LINEAR))
{
}

VkDescriptorSet FilterLayout::makeSet(const FilterBindings& bindings)
{
    const VkDescriptorSet set = sets_.take("shadow filter");
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        bindings.source_is_depth
            ? DescriptorSets::image(kSource, nearest_.get(), bindings.source, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)
            : DescriptorSets::image(kSource, linear_.get(), bindings.source, VK_IMAGE_LAYOUT_GENERAL),
        DescriptorSets::image(kTarget, VK_NULL_HANDLE, bindings.target, VK_IMAGE_LAYOUT_GENERAL),
        DescriptorSets::buffer(kBlocks, bindings.blocks),
        DescriptorSets::buffer(kDepthLayers, bindings.depth_layers),
        DescriptorSets::buffer(kKernel, bindings.kernel, sizeof(shared::BlurKernel)),
        DescriptorSets::buffer(kCounts, bindings.counts, sizeof(shared::BlurCounts))};
    sets_.write(set, writes);
    return set;
}

Pipeline FilterLayout::makeCompute(std::span<const std::uint32_t> spirv, const pack::FilterConstants& constants,
                                   const char* name)
{
    const Specialisation specialisation(constants);
    return makeComputePipeline(device_, {spirv, specialisation.info(), layout_.get(), cache_, name});
}

Pipeline FilterLayout::makeFragment(std::span<const std::uint32_t> spirv, const pack::FilterConstants& constants,
                                    VkFormat format, const char* name)
{
    const ShaderModule vertex = makeShader(device_, spirv::mask_vert);
    const ShaderModule fragment = makeShader(device_, spirv);
    const Specialisation specialisation(constants);
    const TwoStages stages = stagesOf(vertex, fragment, specialisation.info());
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
