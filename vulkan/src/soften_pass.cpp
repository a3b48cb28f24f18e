// SPDX-License-Identifier: Apache-2.0
#include "soften_pass.h"

#include "barriers.h"
#include "mask_history.h"
#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"

#include <gnomon/shared/discs.h>
#include <gnomon/shared/gpu_structs.h>
#include <gnomon/shared/screen_blur.h>
#include <gnomon_spirv.h>

#include <algorithm>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kConstants, kDepth, kNormal, kSource, kPoints, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};

// Specialisation constants of soften.frag and soften_spread.frag.
struct Constants {
    std::int32_t scale;
    VkBool32 edge_aware;
    VkBool32 has_normals;
    std::int32_t kernel;
    VkBool32 in_software;
};

// Their push constants.
struct Push {
    glm::ivec4 sizes;
    glm::ivec4 how;
    glm::vec4 along;
};

VkExtent2D scaled(VkExtent2D extent, std::uint32_t scale)
{
    return {(extent.width + scale - 1) / scale, (extent.height + scale - 1) / scale};
}

bool isWithin(VkExtent2D a, VkExtent2D b)
{
    return a.width <= b.width && a.height <= b.height;
}

bool passesTwice(const ScreenBlurOptions& blur)
{
    return blur.kernel != ScreenKernel::poisson && blur.passes == 2;
}

/// Its last pass reads an image and draws to the mask as it is; else what it left is spread over the mask.
bool endsInMask(const ScreenBlurOptions& blur)
{
    return passesTwice(blur) && blur.size == ScreenSize::full;
}

std::int32_t kernelNumber(const ScreenBlurOptions& blur)
{
    const bool published = blur.kernel == ScreenKernel::gaussian && blur.taps == ScreenTaps::published;
    return published ? shared::kScreenPublished : static_cast<std::int32_t>(blur.kernel);
}

SoftenPipelineKey keyOf(VkFormat format, const ScreenBlurOptions& blur, bool normals)
{
    SoftenPipelineKey key;
    key.format = format;
    key.scale = static_cast<std::int32_t>(pixelsPerTexel(blur.size));
    key.edge_aware = blur.edges == ScreenEdges::aware;
    key.normals = normals;
    key.kernel = kernelNumber(blur);
    return key;
}

/// A triangle over `extent` of a layer, whose barrier makes it an attachment before and readable afterwards.
struct Target {
    const Image& image;
    std::uint32_t layer;
    VkExtent2D extent;
    bool keeps; // keeps texels that are not drawn to
    VkPipelineStageFlags2 readers;
};

ImageBarrier barrierOf(const Target& target)
{
    ImageBarrier barrier;
    barrier.image = target.image.image();
    barrier.first_layer = target.layer;
    return barrier;
}

void begin(const Device& device, VkCommandBuffer commands, const Target& target)
{
    ImageBarrier barrier = barrierOf(target);
    barrier.old_layout = target.keeps ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.source_stages = target.readers;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, commands, barrier);
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.image.layer(target.layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = target.keeps ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = target.extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    device.vk.CmdBeginRendering(commands, &info);
    const VkViewport viewport{
        0.0F, 0.0F, static_cast<float>(target.extent.width), static_cast<float>(target.extent.height), 0.0F, 1.0F};
    device.vk.CmdSetViewport(commands, 0, 1, &viewport);
    device.vk.CmdSetScissor(commands, 0, 1, &info.renderArea);
}

void end(const Device& device, VkCommandBuffer commands, const Target& target)
{
    device.vk.CmdEndRendering(commands);
    ImageBarrier barrier = barrierOf(target);
    barrier.old_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = target.readers;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    if ((target.readers & VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT) != 0) {
        barrier.target_access |= VK_ACCESS_2_TRANSFER_READ_BIT;
    }
    recordBarrier(device, commands, barrier);
}

} // namespace

SoftenPass::SoftenPass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache)
    : device_(device), cache_(cache), nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      linear_(makeSampler(device, VK_FILTER_LINEAR)), sets_(device, kTypes, VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(Push))),
      points_(device, shared::kDiscPoints / 2 * sizeof(glm::vec4), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
              "points of the screen's blur"),
      slots_(frames_in_flight)
{
    const std::span points(static_cast<glm::vec4*>(points_.data()), shared::kDiscPoints / 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {shared::kPoissonPoints[2 * i], shared::kPoissonPoints[2 * i + 1]};
    }
    sets_.reset(kSourceCount * frames_in_flight);
    for (Slot& slot : slots_) {
        for (VkDescriptorSet& set : slot.sets) {
            set = sets_.take("soften");
        }
    }
}

VkPipeline SoftenPass::pipeline(const SoftenPipelineKey& key)
{
    const auto found = std::ranges::find(pipelines_, key, &Made::key);
    if (found != pipelines_.end()) {
        return found->pipeline.get();
    }
    const ShaderModule vertex = makeShader(device_, spirv::mask_vert);
    const ShaderModule fragment =
        key.spreads ? makeShader(device_, spirv::soften_spread_frag) : makeShader(device_, spirv::soften_frag);
    const Specialisation constants(Constants{key.scale, key.edge_aware ? VK_TRUE : VK_FALSE,
                                             key.normals ? VK_TRUE : VK_FALSE, key.kernel,
                                             device_.software() ? VK_TRUE : VK_FALSE});
    const TwoStages stages = stagesOf(vertex, fragment, constants.info());
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = key.format;
    state.chooses_channels = key.chooses_channels;
    state.cache = cache_;
    state.name = key.spreads ? "soften, spread" : "soften";
    return pipelines_.emplace_back(Made{key, makeGraphicsPipeline(device_, state)}).pipeline.get();
}

void SoftenPass::warmUp(VkFormat mask_format, const ScreenBlurOptions& blur, bool normals, bool some)
{
    SoftenPipelineKey key = keyOf(mask_format, blur, normals);
    (void)pipeline(key);
    key.spreads = !endsInMask(blur);
    (void)pipeline(key);
    key.chooses_channels = some;
    (void)pipeline(key);
}

SoftenPass::Extents SoftenPass::extentsFor(const ImageInfo& mask, const Plan& plan)
{
    Extents extents{};
    const auto grow = [](VkExtent2D& extent, VkExtent2D wanted) {
        extent = {std::max(extent.width, wanted.width), std::max(extent.height, wanted.height)};
    };
    for (const ResolvedOptions& options : *plan.options) {
        if (options.technique().soften == Soften::blur) {
            const ScreenBlurOptions& blur = options.screen_blur();
            const VkExtent2D wanted = scaled(mask.extent, pixelsPerTexel(blur.size));
            grow(extents[0], wanted);
            if (passesTwice(blur) && !endsInMask(blur)) {
                grow(extents[1], wanted);
            }
        }
    }
    return extents;
}

bool SoftenPass::holds(const ImageInfo& mask, const Plan& plan) const
{
    const Extents extents = extentsFor(mask, plan);
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const ImageInfo& have = images_[i].info();
        const bool wanted = extents[i].width > 0;
        if (wanted && !(images_[i] && have.format == mask.format && isWithin(extents[i], have.extent))) {
            return false;
        }
    }
    return true;
}

void SoftenPass::prepare(const ImageInfo& mask, const Plan& plan)
{
    draws_.reserve(plan.lights.size());
    const Extents extents = extentsFor(mask, plan);
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const ImageInfo& have = images_[i].info();
        const bool fits = images_[i] ? have.format == mask.format && have.extent.width == extents[i].width &&
                                           have.extent.height == extents[i].height
                                     : extents[i].width == 0;
        if (fits) {
            continue;
        }
        device_.retire(std::move(images_[i]));
        if (extents[i].width > 0) {
            ImageInfo info;
            info.format = mask.format;
            info.extent = extents[i];
            info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
            info.purpose = "screen blur";
            images_[i] = Image(device_, info);
        }
    }
}

void SoftenPass::writeSets(const Slot& slot, const SoftenInputs& inputs, const Image& mask)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const bool has_normals = inputs.normal != VK_NULL_HANDLE;
    const std::array<const Image*, kSourceCount> sources{&mask, &images_[0], &images_[1]};
    for (std::uint32_t i = 0; i < kSourceCount; ++i) {
        if (!*sources[i]) {
            continue; // no draw has it
        }
        const std::array<DescriptorSets::Write, kBindingCount> writes{
            DescriptorSets::buffer(kConstants, inputs.constants, sizeof(shared::GpuConstants)),
            DescriptorSets::image(kDepth, nearest_.get(), inputs.depth, inputs.depth_layout),
            DescriptorSets::image(kNormal, nearest_.get(), has_normals ? inputs.normal : inputs.depth,
                                  has_normals ? kRead : inputs.depth_layout),
            DescriptorSets::image(kSource, linear_.get(), sources[i]->view(), kRead),
            DescriptorSets::buffer(kPoints, points_.buffer())};
        sets_.write(slot.sets[i], writes);
    }
}

void SoftenPass::recordDraw(VkCommandBuffer commands, const Slot& slot, const pack::SoftenDraw& draw, bool normals,
                            const Image& mask, VkPipelineStageFlags2 readers)
{
    const VkExtent2D full = mask.info().extent;
    const std::uint32_t scale = pixelsPerTexel(draw.blur.size);
    const VkExtent2D small = scaled(full, scale);
    const Target first{images_[0], 0, small, false, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT};
    const Target second{images_[1], 0, small, false, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT};
    const Target last{mask, draw.layer, full, true, readers};
    const auto pass = [&](const Target& target, Source source, const glm::vec2& direction, bool spreads) {
        SoftenPipelineKey key = keyOf(mask.info().format, draw.blur, normals);
        key.spreads = spreads;
        key.chooses_channels = target.keeps && !draw.whole;
        const VkExtent2D read = source == kMask ? full : small;
        Push push{};
        push.sizes = {read.width, read.height, full.width, full.height};
        push.how = {source == kMask ? 1 : static_cast<int>(scale), source == kMask ? static_cast<int>(draw.layer) : 0,
                    static_cast<int>(draw.blur.points), 0};
        push.along = {direction, draw.blur.strength_px, 0.0F};
        begin(device_, commands, target);
        device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline(key));
        device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1,
                                         &slot.sets[source], 0, nullptr);
        device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push, &push);
        if (key.chooses_channels) {
            const auto chosen = [&](std::uint32_t channel) {
                return (draw.channels >> channel & 1U) != 0 ? 1.0F : 0.0F;
            };
            const std::array<float, 4> channels{chosen(0), chosen(1), chosen(2), chosen(3)};
            device_.vk.CmdSetBlendConstants(commands, channels.data());
        }
        device_.vk.CmdDraw(commands, 3, 1, 0, 0);
        end(device_, commands, target);
    };
    constexpr glm::vec2 kAcross(1.0F, 0.0F);
    constexpr glm::vec2 kDown(0.0F, 1.0F);
    pass(first, kMask, kAcross, false);
    if (endsInMask(draw.blur)) {
        pass(last, kFirst, kDown, false);
        return;
    }
    const bool twice = passesTwice(draw.blur);
    if (twice) {
        pass(second, kFirst, kDown, false);
    }
    pass(last, twice ? kSecond : kFirst, kAcross, true);
}

void SoftenPass::record(VkCommandBuffer commands, std::uint32_t slot_index, const Plan& plan,
                        const SoftenInputs& inputs, const Image& mask, VkPipelineStageFlags2 readers)
{
    const Slot& slot = slots_[slot_index];
    writeSets(slot, inputs, mask);
    pack::listSoftenDraws(plan, draws_);
    device_.beginLabel(commands, "soften");
    for (const pack::SoftenDraw& draw : draws_) {
        recordDraw(commands, slot, draw, inputs.normal != VK_NULL_HANDLE, mask, readers);
    }
    device_.endLabel(commands);
}

} // namespace gnomon::vulkan
