// SPDX-License-Identifier: Apache-2.0
#include "mask_spread.h"

#include "mask_marks.h"
#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"

#include <gnomon/shared/gpu_structs.h>
#include <gnomon_spirv.h>

#include <algorithm>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kConstants, kDepth, kNormal, kSource, kObjectId, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

// Specialisation constants of mask_spread.frag.
struct Constants {
    VkBool32 has_normals;
    VkBool32 in_software;
    VkBool32 has_ids;
};

ImageInfo halfOf(const ImageInfo& mask)
{
    ImageInfo info;
    info.format = mask.format;
    info.extent = {(mask.extent.width + 1) / 2, (mask.extent.height + 1) / 2};
    info.layers = mask.layers;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    info.purpose = "half mask";
    return info;
}

} // namespace

MaskSpread::MaskSpread(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache)
    : device_(device), cache_(cache), nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kTypes, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, 0)), slots_(frames_in_flight)
{
    sets_.reset(frames_in_flight);
    for (VkDescriptorSet& set : slots_) {
        set = sets_.take("mask spread");
    }
}

VkPipeline MaskSpread::pipeline(const Key& key)
{
    const auto found = std::ranges::find(pipelines_, key, &Made::key);
    if (found != pipelines_.end()) {
        return found->pipeline.get();
    }
    const ShaderModule vertex = makeShader(device_, spirv::mask_screen_vert);
    const ShaderModule fragment = makeShader(device_, spirv::mask_spread_frag);
    const Specialisation specialisation(Constants{
        key.normals ? VK_TRUE : VK_FALSE, device_.software() ? VK_TRUE : VK_FALSE, key.ids ? VK_TRUE : VK_FALSE});
    const TwoStages stages = stagesOf(vertex, fragment, specialisation.info());
    const VkPipelineDepthStencilStateCreateInfo marks = MaskMarks::marking();
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = key.format;
    state.keeps_least = true; // lights that were drawn beside have 1 in half()
    state.depth_format = MaskMarks::kFormat;
    state.depth_stencil = &marks;
    state.cache = cache_;
    state.name = "mask spread";
    return pipelines_.emplace_back(Made{key, makeGraphicsPipeline(device_, state)}).pipeline.get();
}

bool MaskSpread::holds(const ImageInfo& mask) const
{
    const ImageInfo wanted = halfOf(mask);
    const ImageInfo& have = half_.info();
    return half_ && have.format == wanted.format && have.layers == wanted.layers &&
           have.extent.width == wanted.extent.width && have.extent.height == wanted.extent.height;
}

void MaskSpread::prepare(const ImageInfo& mask)
{
    if (holds(mask)) {
        return;
    }
    Image half(device_, halfOf(mask));
    device_.retire(std::move(half_));
    half_ = std::move(half);
}

void MaskSpread::begin(std::uint32_t slot, const SpreadInputs& inputs)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    normals_ = inputs.normal != VK_NULL_HANDLE;
    ids_ = inputs.object_id != VK_NULL_HANDLE;
    set_ = slots_[slot];
    const VkSampler sampler = nearest_.get();
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kConstants, inputs.constants, sizeof(shared::GpuConstants)),
        DescriptorSets::image(kDepth, sampler, inputs.depth, inputs.depth_layout),
        DescriptorSets::image(kNormal, sampler, normals_ ? inputs.normal : inputs.depth,
                              normals_ ? kRead : inputs.depth_layout),
        DescriptorSets::image(kSource, sampler, half_.view(), kRead),
        DescriptorSets::image(kObjectId, sampler, ids_ ? inputs.object_id : inputs.no_numbers, kRead)};
    sets_.write(set_, writes);
}

void MaskSpread::spread(VkCommandBuffer commands, const Image& target, std::uint32_t layer, const VkRect2D& area)
{
    const VkExtent2D full = target.info().extent;
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(full.width), static_cast<float>(full.height), 0.0F, 1.0F};
    device_.vk.CmdSetViewport(commands, 0, 1, &viewport);
    device_.vk.CmdSetScissor(commands, 0, 1, &area);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                               pipeline({target.info().format, normals_, ids_}));
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set_, 0, nullptr);
    device_.vk.CmdDraw(commands, 3, 1, 0, layer); // its first instance is the shader's layer
}

} // namespace gnomon::vulkan
