// SPDX-License-Identifier: Apache-2.0
#include "map_restore.h"

#include "pipelines.h"
#include "samplers.h"

#include <gnomon/shared/paired_depth.h>
#include <gnomon_spirv.h>

namespace gnomon::vulkan {
namespace {

// Push constants of restore.frag.
struct Kept {
    std::int32_t layer = 0;
    std::int32_t holding = shared::kDepthAlone;
    float part = 0.0F;
};

std::int32_t holdingOf(VkFormat colour)
{
    return colour == VK_FORMAT_R8G8B8A8_UNORM ? shared::kDepthBytes : shared::kDepthChannel;
}

constexpr std::array kTypes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                            VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}; // depths, colours

} // namespace

MapRestorer::MapRestorer(Device& device, const MapStorage& storage, VkPipelineCache cache)
    : device_(device), storage_(storage), cache_(cache), sampler_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kTypes, VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(Kept)))
{
}

void MapRestorer::setKept(VkImageView depths, VkImageView colours)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    sets_.reset(1); // frames in flight may use the set that was there
    set_ = sets_.take("restore");
    // Every descriptor is written [drivers: unwritten].
    const std::array writes{
        DescriptorSets::image(0, sampler_.get(), depths != VK_NULL_HANDLE ? depths : colours, kRead),
        DescriptorSets::image(1, sampler_.get(), colours != VK_NULL_HANDLE ? colours : depths, kRead)};
    sets_.write(set_, writes);
}

Pipeline MapRestorer::makePipeline(std::span<const std::uint32_t> fragment, TexelPart part)
{
    const ShaderModule vertex_module = makeShader(device_, spirv::mask_vert);
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

std::span<const std::uint32_t> MapRestorer::codeFor(Source source) const
{
    if (source == Source::colours) {
        return spirv::restore_shared_frag;
    }
    return storage_.depthOnly() ? std::span<const std::uint32_t>(spirv::restore_depth_frag)
                                : std::span<const std::uint32_t>(spirv::restore_colour_frag);
}

void MapRestorer::ensure(TexelPart part, Source source)
{
    const auto index = static_cast<std::size_t>(part);
    if (Pipeline& restored = restores_[index][static_cast<std::size_t>(source)]; !restored) {
        restored = makePipeline(codeFor(source), part);
    }
    if (!clears_[index] && part != TexelPart::whole) {
        clears_[index] = makePipeline(spirv::restore_clear_frag, part);
    }
}

void MapRestorer::restore(VkCommandBuffer commands, TexelPart part, Source source, std::uint32_t layer)
{
    const Pipeline& pipeline = restores_[static_cast<std::size_t>(part)][static_cast<std::size_t>(source)];
    const Kept push{static_cast<std::int32_t>(layer), holdingOf(storage_.colour),
                    part == TexelPart::second ? 1.0F : 0.0F};
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
