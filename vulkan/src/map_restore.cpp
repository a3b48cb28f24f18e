// SPDX-License-Identifier: Apache-2.0
#include "map_restore.h"

#include "pipelines.h"
#include "samplers.h"

#include <gnomon_spirv.h>

namespace gnomon::vulkan {
namespace {

using Layer = std::int32_t; // push constant of restore.frag

constexpr std::array kTypes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                            VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}; // depths, colours

} // namespace

MapRestorer::MapRestorer(Device& device, const MapStorage& storage, VkPipelineCache cache)
    : device_(device), storage_(storage), cache_(cache), sampler_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kTypes, VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(Layer)))
{
}

void MapRestorer::setKept(VkImageView depths, VkImageView colours)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    sets_.reset(1); // frames in flight may use the set that was there
    set_ = sets_.take("restore");
    // Lavapipe 22.3 crashes on a descriptor that was never written even if no shader names it.
    const std::array writes{
        DescriptorSets::image(0, sampler_.get(), depths, kRead),
        DescriptorSets::image(1, sampler_.get(), colours != VK_NULL_HANDLE ? colours : depths, kRead)};
    sets_.write(set_, writes);
}

Pipeline MapRestorer::makePipeline(std::span<const std::uint32_t> fragment, TexelPart part)
{
    const ShaderModule vertex_module = makeShader(device_, spirv::restore_vert);
    const ShaderModule fragment_module = makeShader(device_, fragment);
    const TwoStages stages = stagesOf(vertex_module, fragment_module);
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

void MapRestorer::ensure(TexelPart part)
{
    const auto index = static_cast<std::size_t>(part);
    if (!restores_[index]) {
        restores_[index] =
            makePipeline(storage_.depthOnly() ? spirv::restore_depth_frag : spirv::restore_colour_frag, part);
    }
    if (!clears_[index] && part != TexelPart::whole) {
        clears_[index] = makePipeline(spirv::restore_clear_frag, part);
    }
}

void MapRestorer::restore(VkCommandBuffer commands, TexelPart part, std::uint32_t layer)
{
    const Pipeline& pipeline = restores_[static_cast<std::size_t>(part)];
    const auto push = static_cast<Layer>(layer);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set_, 0, nullptr);
    device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push, &push);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

void MapRestorer::clear(VkCommandBuffer commands, TexelPart part)
{
    const Pipeline& pipeline = clears_[static_cast<std::size_t>(part)];
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

} // namespace gnomon::vulkan
