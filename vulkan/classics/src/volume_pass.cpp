// SPDX-License-Identifier: Apache-2.0
// Based on: M. McGuire, J. F. Hughes, K. T. Egan, M. J. Kilgard, C. Everitt, "Fast, Practical and Robust Shadows", 2003
// (z-fail with both caps, the scissor and the depth bounds of a light's reach). Departures: depth is clamped in place
// of a far plane at infinity, so that every camera works; and faces are counted behind what is seen (z-fail) wherever
// the eye is, as counting those before it (z-pass) would save only caps. shadow_volume.h has a third one.
#include "volume_pass.h"

#include "barriers.h"
#include "optional_parts.h"
#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"
#include "usage.h"

#include <gnomon/plan_views.h>

#include <gnomon/shared/gpu_structs.h>
#include <gnomon_classic_spirv.h>
#include <gnomon_spirv.h>

#include <algorithm>
#include <array>

namespace gnomon::vulkan {
namespace {

enum CountBinding : std::uint32_t {
    kCountConstants,
    kCountDepth,
    kCountNormal,
    kCountSmooth,
    kCountId,
    kCountBindings
};
constexpr std::array<VkDescriptorType, kCountBindings> kCountTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

// Specialisation constants of volume_mask.frag.
struct VolumeMaskConstants {
    VkBool32 has_normals;
    VkBool32 has_smooth;
    VkBool32 is_inside;
    VkBool32 has_ids;
};

// Constants of volume_depth.frag.
struct VolumeDepthConstants {
    VkBool32 has_smooth;
};

VkRect2D rectOf(const pack::ScreenBounds& pixels)
{
    return {{static_cast<std::int32_t>(pixels.x0), static_cast<std::int32_t>(pixels.y0)},
            {pixels.x1 - pixels.x0, pixels.y1 - pixels.y0}};
}

glm::mat4 clipFromEye(const Camera& camera)
{
    glm::dmat4 clip = camera.clip_from_world;
    clip[3] = camera.clip_from_world * glm::dvec4(camera.eye_ws, 1.0);
    if (isOrthographic(camera)) {
        // Volumes are pushed away from the eye (kVolumePush), and near an orthographic eye's plane that is no depth.
        constexpr double kPush = 4e-6; // share of the depth range
        clip[3].z += camera.reversed_z ? -kPush : kPush;
    }
    return {clip};
}

MaskShape shapeOf(const MaskInputs& inputs)
{
    return {inputs.normal != VK_NULL_HANDLE, inputs.object_id != VK_NULL_HANDLE, inputs.smooth != VK_NULL_HANDLE};
}

bool isSame(const MaskShape& a, const MaskShape& b)
{
    return a.normals == b.normals && a.ids == b.ids && a.smooth == b.smooth;
}

/// Waits for earlier drawing to the mask, and until the depth buffer is free again.
void awaitBefore(const Device& device, VkCommandBuffer commands, const Image& depth)
{
    constexpr VkPipelineStageFlags2 kTests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    BarrierBatch batch(device, commands);
    ImageBarrier to_depth;
    to_depth.image = depth.image();
    to_depth.aspect = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    to_depth.new_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    to_depth.source_stages = kTests;
    to_depth.source_access = kWrites;
    to_depth.target_stages = kTests;
    to_depth.target_access = kWrites | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    batch.add(to_depth);
    MemoryBarrier colour;
    colour.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    colour.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    colour.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    colour.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    batch.add(colour);
}

} // namespace

VolumePassRecorder::VolumePassRecorder(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache,
                                       const DrawVolumes& draw)
    : device_(device), draw_(draw), depth_stencil_(stencilFormat(device.view())), slot_count_(frames_in_flight),
      cache_(cache), nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kCountTypes, VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(glm::vec4))),
      triangle_(makeShader(device, spirv::mask_vert))
{
}

void VolumePassRecorder::makeSets(std::uint32_t options)
{
    options_ = options;
    sets_.reset(slot_count_ * options);
    slot_sets_.clear();
    for (std::uint32_t i = 0; i < slot_count_ * options; ++i) {
        slot_sets_.push_back(sets_.take("mask by volumes"));
    }
}

void VolumePassRecorder::prepare(const Plan& plan, const ImageInfo& mask, const MaskShape& shape)
{
    const VkExtent2D screen = mask.extent;
    requirePart(device_, "count shadow volumes", &FeatureUses::depth_clamp);
    draws_.reserve(plan.lights.size());
    if (const auto options = static_cast<std::uint32_t>(plan.options->size()); options > options_) {
        makeSets(options);
    }
    const VkExtent2D have = depth_.info().extent;
    if (!depth_ || have.width != screen.width || have.height != screen.height) {
        device_.retire(std::move(depth_));
        depth_ = Image(device_, {depth_stencil_, screen, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT, "volume stencil"});
    }
    for (const LightPlan& light : plan.lights) {
        if (light.volume_count > 0) {
            warmUp({mask.format, maskChannelsOf(light), shape});
        }
    }
}

void VolumePassRecorder::warmUp(const MaskKind& mask)
{
    (void)copyPipeline(mask.format, mask.shape.smooth);
    for (const bool inside : {false, true}) {
        (void)maskPipeline({mask.format, mask.channels, mask.shape, inside});
    }
}

VkPipeline VolumePassRecorder::maskPipeline(const Key& key)
{
    const auto found = std::ranges::find_if(pipelines_, [&](const Made& made) {
        return made.key.format == key.format && made.key.channels == key.channels && made.key.inside == key.inside &&
               isSame(made.key.shape, key.shape);
    });
    return found != pipelines_.end() ? found->pipeline.get()
                                     : pipelines_.emplace_back(Made{key, makeMaskPipeline(key)}).pipeline.get();
}

Pipeline VolumePassRecorder::makeMaskPipeline(const Key& key)
{
    const ShaderModule fragment = makeShader(device_, spirv::volume_mask_frag);
    const Specialisation constants(
        VolumeMaskConstants{key.shape.normals ? VK_TRUE : VK_FALSE, key.shape.smooth ? VK_TRUE : VK_FALSE,
                            key.inside ? VK_TRUE : VK_FALSE, key.shape.ids ? VK_TRUE : VK_FALSE});
    const TwoStages stages = stagesOf(triangle_, fragment, constants.info());
    VkPipelineDepthStencilStateCreateInfo counted{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    counted.stencilTestEnable = VK_TRUE;
    counted.front.failOp = VK_STENCIL_OP_KEEP;
    counted.front.passOp = VK_STENCIL_OP_KEEP;
    counted.front.depthFailOp = VK_STENCIL_OP_KEEP;
    counted.front.compareOp = key.inside ? VK_COMPARE_OP_NOT_EQUAL : VK_COMPARE_OP_EQUAL;
    counted.front.compareMask = 0xFF;
    counted.back = counted.front;
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = key.format;
    state.colour_mask = key.channels; // channel i is bit i there, too
    state.depth_format = depth_stencil_;
    state.stencil_format = depth_stencil_;
    state.depth_stencil = &counted;
    state.cache = cache_;
    state.name = "mask by volumes";
    return makeGraphicsPipeline(device_, state);
}

VkPipeline VolumePassRecorder::copyPipeline(VkFormat format, bool smooth)
{
    const auto found =
        std::ranges::find_if(copies_, [&](const Copy& copy) { return copy.format == format && copy.smooth == smooth; });
    return found != copies_.end()
               ? found->pipeline.get()
               : copies_.emplace_back(Copy{format, smooth, makeCopyPipeline(format, smooth)}).pipeline.get();
}

Pipeline VolumePassRecorder::makeCopyPipeline(VkFormat format, bool smooth)
{
    const ShaderModule fragment = makeShader(device_, spirv::volume_depth_frag);
    const Specialisation constants(VolumeDepthConstants{smooth ? VK_TRUE : VK_FALSE});
    const TwoStages stages = stagesOf(triangle_, fragment, constants.info());
    VkPipelineDepthStencilStateCreateInfo written{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    written.depthTestEnable = VK_TRUE;
    written.depthWriteEnable = VK_TRUE;
    written.depthCompareOp = VK_COMPARE_OP_ALWAYS;
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = format;
    state.colour_mask = 0;
    state.depth_format = depth_stencil_;
    state.stencil_format = depth_stencil_;
    state.depth_stencil = &written;
    state.cache = cache_;
    state.name = "depth for volumes";
    return makeGraphicsPipeline(device_, state);
}

void VolumePassRecorder::writeSets(const MaskJob& job)
{
    const MaskInputs& inputs = job.inputs;
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = nearest_.get();
    // Every descriptor is written [drivers: unwritten].
    const auto orDepth = [&](std::uint32_t binding, VkImageView view) {
        return view != VK_NULL_HANDLE ? DescriptorSets::image(binding, sampler, view, kRead)
                                      : DescriptorSets::image(binding, sampler, inputs.depth, inputs.depth_layout);
    };
    for (std::uint32_t options = 0; options < options_; ++options) {
        const std::array<DescriptorSets::Write, kCountBindings> writes{
            DescriptorSets::buffer(kCountConstants, job.constants, sizeof(shared::GpuConstants),
                                   options * job.constants_stride),
            DescriptorSets::image(kCountDepth, sampler, inputs.depth, inputs.depth_layout),
            orDepth(kCountNormal, inputs.normal), orDepth(kCountSmooth, inputs.smooth),
            DescriptorSets::image(kCountId, sampler,
                                  inputs.object_id != VK_NULL_HANDLE ? inputs.object_id : job.no_numbers.layer(),
                                  kRead)};
        sets_.write(setOf(job.slot, options), writes);
    }
}

void VolumePassRecorder::beginLayer(VkCommandBuffer commands, const Image& target, std::uint32_t layer)
{
    awaitBefore(device_, commands, depth_);
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = depth_.layer(0);
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    const VkExtent2D extent = target.info().extent;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    info.pDepthAttachment = &depth;
    info.pStencilAttachment = &depth;
    device_.vk.CmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    device_.vk.CmdSetViewport(commands, 0, 1, &viewport);
}

/// Where some light of the layer counts.
void VolumePassRecorder::copyDepth(const MaskJob& job, VkFormat format, std::uint32_t layer)
{
    pack::ScreenBounds all{~0U, ~0U, 0, 0};
    for (const pack::VolumeDraw& draw : draws_) {
        if (draw.layer == layer) {
            all = {std::min(all.x0, draw.pixels.x0), std::min(all.y0, draw.pixels.y0), std::max(all.x1, draw.pixels.x1),
                   std::max(all.y1, draw.pixels.y1)};
        }
    }
    const VkRect2D scissor = rectOf(all);
    const VkDescriptorSet set = setOf(job.slot, 0);
    device_.vk.CmdSetScissor(job.commands, 0, 1, &scissor);
    device_.vk.CmdBindPipeline(job.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                               copyPipeline(format, job.inputs.smooth != VK_NULL_HANDLE));
    device_.vk.CmdBindDescriptorSets(job.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0,
                                     nullptr);
    device_.vk.CmdDraw(job.commands, 3, 1, 0, 0);
}

void VolumePassRecorder::countLight(const MaskJob& job, VkFormat format, const pack::VolumeDraw& draw)
{
    const LightPlan& light = job.plan.lights[draw.light];
    const VkRect2D scissor = rectOf(draw.pixels);
    device_.vk.CmdSetScissor(job.commands, 0, 1, &scissor);
    VkClearAttachment uncounted{};
    uncounted.aspectMask = VK_IMAGE_ASPECT_STENCIL_BIT;
    const VkClearRect where{scissor, 0, 1};
    device_.vk.CmdClearAttachments(job.commands, 1, &uncounted, 1, &where);
    if (device_.uses().depth_bounds) {
        device_.vk.CmdSetDepthBounds(job.commands, draw.least_depth, draw.most_depth);
    }
    VolumePass pass;
    pass.commands = job.commands;
    pass.colour = format;
    pass.depth_stencil = depth_stencil_;
    pass.reversed_z = job.plan.made_for.camera.reversed_z;
    pass.plan = &job.plan;
    pass.light = draw.light;
    pass.casters = std::span(job.plan.casters).subspan(light.first_volume, light.volume_count);
    pass.clip_from_eye = clipFromEye(job.plan.made_for.camera);
    pass.eye_ws = job.plan.made_for.camera.eye_ws;
    pass.place = draw.place;
    draw_(pass);
}

void VolumePassRecorder::drawLight(const MaskJob& job, VkFormat format, const pack::VolumeDraw& draw)
{
    const VkDescriptorSet set = setOf(job.slot, job.plan.lights[draw.light].options);
    for (const bool inside : {false, true}) {
        device_.vk.CmdBindPipeline(job.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                   maskPipeline({format, draw.channels, shapeOf(job.inputs), inside}));
        device_.vk.CmdBindDescriptorSets(job.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0,
                                         nullptr);
        device_.vk.CmdPushConstants(job.commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof draw.place,
                                    &draw.place);
        device_.vk.CmdDraw(job.commands, 3, 1, 0, 0);
    }
}

void VolumePassRecorder::record(const MaskJob& job, const Image& mask)
{
    const VkCommandBuffer commands = job.commands;
    const VkFormat format = mask.info().format;
    const VkExtent2D extent = mask.info().extent;
    pack::listVolumeDraws(job.plan, {extent.width, extent.height}, draws_);
    if (draws_.empty()) {
        return;
    }
    writeSets(job);
    device_.beginLabel(commands, "shadow volumes");
    for (std::uint32_t layer = 0; layer < mask.info().layers; ++layer) {
        const auto is_here = [&](const pack::VolumeDraw& draw) {
            return draw.layer == layer;
        };
        if (std::ranges::none_of(draws_, is_here)) {
            continue;
        }
        beginLayer(commands, mask, layer);
        copyDepth(job, format, layer);
        for (const pack::VolumeDraw& draw : draws_) {
            if (is_here(draw)) {
                countLight(job, format, draw);
                drawLight(job, format, draw);
            }
        }
        device_.vk.CmdEndRendering(commands);
    }
    device_.endLabel(commands);
}

} // namespace gnomon::vulkan
