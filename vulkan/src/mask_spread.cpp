// SPDX-License-Identifier: Apache-2.0
#include "mask_spread.h"

#include "barriers.h"
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

constexpr VkPipelineStageFlags2 kTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

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

VkPipelineDepthStencilStateCreateInfo MaskSpread::whereLeft()
{
    VkPipelineDepthStencilStateCreateInfo state{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    state.depthTestEnable = VK_TRUE;
    state.depthCompareOp = VK_COMPARE_OP_LESS;
    return state;
}

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
    VkPipelineDepthStencilStateCreateInfo marks{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    marks.depthTestEnable = VK_TRUE; // without it nothing is written
    marks.depthWriteEnable = VK_TRUE;
    marks.depthCompareOp = VK_COMPARE_OP_ALWAYS;
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = key.format;
    state.keeps_least = true; // lights that were drawn beside have 1 in half()
    state.depth_format = kMarkFormat;
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
           marks_.info().extent.width == mask.extent.width && marks_.info().extent.height == mask.extent.height;
}

void MaskSpread::prepare(const ImageInfo& mask)
{
    if (holds(mask)) {
        return;
    }
    Image half(device_, halfOf(mask));
    Image marks(device_, {kMarkFormat, mask.extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                          VK_IMAGE_ASPECT_DEPTH_BIT, "half mask"});
    device_.retire(std::move(half_));
    device_.retire(std::move(marks_));
    half_ = std::move(half);
    marks_ = std::move(marks);
}

void MaskSpread::begin(VkCommandBuffer commands, std::uint32_t slot, const SpreadInputs& inputs, const Image& target)
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
    ImageBarrier drawn_to;
    drawn_to.image = target.image();
    drawn_to.layer_count = target.info().layers;
    drawn_to.old_layout = drawn_to.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    drawn_to.source_stages = drawn_to.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    drawn_to.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    drawn_to.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device_, commands, drawn_to);
}

void MaskSpread::spread(VkCommandBuffer commands, const Image& target, std::uint32_t layer, const VkRect2D& area,
                        bool keeps)
{
    const VkExtent2D full = target.info().extent;
    ImageBarrier free; // after the last layer, or the last frame
    free.image = marks_.image();
    free.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    free.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    free.source_stages = free.target_stages = kTests;
    free.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    free.target_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    recordBarrier(device_, commands, free);
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = keeps ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color = {{1.0F, 1.0F, 1.0F, 1.0F}};
    VkRenderingAttachmentInfo marks{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    marks.imageView = marks_.layer(0);
    marks.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    marks.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    marks.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    marks.clearValue.depthStencil = {1.0F, 0};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = full;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    info.pDepthAttachment = &marks;
    device_.vk.CmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(full.width), static_cast<float>(full.height), 0.0F, 1.0F};
    device_.vk.CmdSetViewport(commands, 0, 1, &viewport);
    device_.vk.CmdSetScissor(commands, 0, 1, &area);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                               pipeline({target.info().format, normals_, ids_}));
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set_, 0, nullptr);
    device_.vk.CmdDraw(commands, 3, 1, 0, layer); // its first instance is the shader's layer
}

} // namespace gnomon::vulkan
