// SPDX-License-Identifier: Apache-2.0
#include "alternate_pass.h"

#include "pipelines.h"
#include "samplers.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/sun_steps.h>
#include <gnomon_classic_spirv.h>
#include <gnomon_spirv.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kConstants, kDepth, kNow, kBefore, kDistances, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

// `surfaces` holds the distance from the eye, metres; 0: there is none.
constexpr MaskHistory::Kind kHistory{.surfaces = VK_FORMAT_R32_SFLOAT};

// Push constants of alternate.frag.
struct Push {
    Reprojection before; // eye.w: layer of the images
    glm::vec4 weights;
};

// Both are unit. Planners carry a direction over from step to step as it is; what is this near is the same to the eye.
bool isSameDirection(const glm::dvec3& a, const glm::dvec3& b)
{
    constexpr double kNear = 1e-6;
    return glm::length(a - b) < kNear;
}

const glm::dvec3& directionRead(const SunSteps& steps)
{
    return steps.read == SunPosition::later ? steps.later_ws : steps.earlier_ws;
}

const glm::dvec3& directionNotRead(const SunSteps& steps)
{
    return steps.read == SunPosition::later ? steps.earlier_ws : steps.later_ws;
}

} // namespace

AlternatePass::AlternatePass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache)
    : device_(device), cache_(cache), sampler_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kTypes, VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(Push))),
      slots_(frames_in_flight), history_(device, kHistory)
{
    sets_.reset(2 * frames_in_flight);
    for (auto& turns : slots_) {
        for (VkDescriptorSet& set : turns) {
            set = sets_.take("alternate");
        }
    }
}

Pipeline AlternatePass::makePipeline(VkFormat mask_format)
{
    const ShaderModule vertex = makeShader(device_, spirv::mask_vert);
    const ShaderModule fragment = makeShader(device_, spirv::alternate_frag);
    const TwoStages stages = stagesOf(vertex, fragment);
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = mask_format;
    state.second_format = kHistory.surfaces;
    state.cache = cache_;
    state.name = "alternate";
    return makeGraphicsPipeline(device_, state);
}

void AlternatePass::warmUp(const MaskKind& mask)
{
    if (std::ranges::find(pipelines_, mask.format, &Made::mask_format) == pipelines_.end()) {
        pipelines_.push_back({mask.format, makePipeline(mask.format)});
    }
}

void AlternatePass::prepare(const Plan& plan, const ImageInfo& mask, const MaskShape&)
{
    warmUp({.format = mask.format});
    lights_.resize(std::max(lights_.size(), plan.lights.size()));
    if (history_.prepare(mask)) {
        forget();
    }
}

void AlternatePass::forget()
{
    std::fill(lights_.begin(), lights_.end(), LightHistory{});
}

void AlternatePass::writeSet(VkDescriptorSet set, const MaskJob& job)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = sampler_.get();
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kConstants, job.constants, sizeof(shared::GpuConstants)),
        DescriptorSets::image(kDepth, sampler, job.inputs.depth, job.inputs.depth_layout),
        DescriptorSets::image(kNow, sampler, history_.now().visibility.view(), kRead),
        DescriptorSets::image(kBefore, sampler, history_.before().visibility.view(), kRead),
        DescriptorSets::image(kDistances, sampler, history_.before().surfaces.view(), kRead)};
    sets_.write(set, writes);
}

glm::vec4 AlternatePass::weightsOfBefore(const Plan& plan, std::uint32_t layer) const
{
    glm::vec4 weights(0.0F);
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& light = plan.lights[i];
        const SunSteps& steps = light.steps;
        const MaskPlace place = maskPlaceOf(light);
        if (place.layer != layer || !pack::takesTurns(light) || !lights_[i].known || lights_[i].place != place ||
            !isSameDirection(lights_[i].direction_ws, directionNotRead(steps))) {
            continue;
        }
        const float weight = shared::weightOfBefore(static_cast<float>(laterWeight(steps, 0.0)),
                                                    steps.read == SunPosition::later ? 1.0F : 0.0F);
        for (int channel = 0; channel < 4; ++channel) {
            weights[channel] = (place.channels >> channel & 1U) != 0 ? weight : weights[channel];
        }
    }
    return weights;
}

void AlternatePass::remember(const Plan& plan)
{
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& light = plan.lights[i];
        lights_[i].known = pack::takesTurns(light);
        lights_[i].place = maskPlaceOf(light);
        lights_[i].direction_ws = directionRead(light.steps);
    }
}

void AlternatePass::recordLayer(VkCommandBuffer commands, const Plan& plan, std::uint32_t layer, const Image& mask)
{
    beginJoining(device_, commands, mask.info().extent,
                 std::array{mask.layer(layer), history_.now().surfaces.layer(layer)});
    Push push{};
    push.before = history_.reprojection(plan);
    push.before.eye.w = static_cast<float>(layer);
    push.weights = weightsOfBefore(plan, layer);
    device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push, &push);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
    device_.vk.CmdEndRendering(commands);
}

void AlternatePass::record(const MaskJob& job, const Image& mask)
{
    const VkCommandBuffer commands = job.commands;
    const Plan& plan = job.plan;
    const VkDescriptorSet set = slots_[job.slot][history_.turn()];
    writeSet(set, job);
    history_.begin(commands);
    device_.beginLabel(commands, "alternate");
    const auto made = std::ranges::find(pipelines_, mask.info().format, &Made::mask_format);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, made->pipeline.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    for (std::uint32_t layer = 0; layer < mask.info().layers; ++layer) {
        recordLayer(commands, plan, layer, mask);
    }
    device_.endLabel(commands);
    remember(plan);
    history_.end(commands, plan);
}

} // namespace gnomon::vulkan
