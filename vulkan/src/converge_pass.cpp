// SPDX-License-Identifier: Apache-2.0
#include "converge_pass.h"

#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/converge.h>
#include <gnomon/shared/gpu_structs.h>
#include <gnomon_spirv.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kConstants, kLayers, kDepth, kNormal, kNow, kMean, kSurface, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

// Half floats: eight bits would lose the part that one of many frames adds. `surfaces` holds the values that
// converge.frag packs.
constexpr MaskHistory::Kind kHistory{.surfaces = VK_FORMAT_R32G32_UINT, .makes_visibility = true, .precise = true};

// The most frames that earlier ones count for, at rest. A half float's step at 1 is 1/2048, which would lose one
// frame's part in a mean of more frames. In motion converge.frag has its own bound.
constexpr float kMostAtRest = 63.0F;

// Specialisation constants of converge.frag.
struct Constants {
    VkBool32 at_rest;
};

/// How far a light moved, as a share of half its width: by so much its penumbra has moved.
double moveOf(const Light& before, const Light& now)
{
    const bool parallel = now.type == LightType::directional;
    const double moved = parallel ? glm::distance(glm::normalize(before.direction_ws), glm::normalize(now.direction_ws))
                                  : glm::distance(before.position_ws, now.position_ws);
    const double half_width = parallel ? 0.5 * now.angular_diameter_rad : now.radius_m;
    constexpr double kRounding = 1e-9;
    if (moved <= kRounding * (parallel ? 1.0 : glm::length(now.position_ws))) {
        return 0.0;
    }
    return half_width > 0.0 ? moved / half_width : std::numeric_limits<double>::infinity();
}

bool isSameLight(const Light& a, const Light& b)
{
    return a.key == b.key && a.type == b.type && a.options == b.options && a.groups == b.groups;
}

/// How far beside a caster the filter may be dark, metres.
double padOf(const Plan& plan, const LightPlan& light, const glm::dvec3& light_to_eye)
{
    const double texels = static_cast<double>((*plan.options)[light.options].reach_texels()) + 1.0;
    double pad_m = 0.0;
    for (const View& view : std::span(plan.views).subspan(light.first_view, light.view_count)) {
        pad_m = std::max(pad_m, texels * view.projection.texel_m *
                                    (view.projection.parallel ? 1.0 : glm::length(light_to_eye)));
    }
    return pad_m;
}

} // namespace

ConvergePass::ConvergePass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache)
    : device_(device), cache_(cache), sampler_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kTypes, VK_SHADER_STAGE_FRAGMENT_BIT),
      layout_(makePipelineLayout(device, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(std::int32_t))),
      slots_(frames_in_flight), history_(device, kHistory)
{
    sets_.reset(2 * frames_in_flight);
    for (Slot& slot : slots_) {
        for (VkDescriptorSet& set : slot.sets) {
            set = sets_.take("converge");
        }
    }
}

Pipeline ConvergePass::makePipeline(VkFormat mask_format, bool at_rest)
{
    const ShaderModule vertex = makeShader(device_, spirv::mask_vert);
    const ShaderModule fragment = makeShader(device_, spirv::converge_frag);
    const Specialisation constants(Constants{at_rest ? VK_TRUE : VK_FALSE});
    const TwoStages stages = stagesOf(vertex, fragment, constants.info());
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = mask_format;
    state.second_format = MaskHistory::visibilityFormat(kHistory, mask_format);
    state.third_format = kHistory.surfaces;
    state.cache = cache_;
    state.name = "converge";
    return makeGraphicsPipeline(device_, state);
}

void ConvergePass::warmUp(const MaskKind& mask)
{
    if (std::ranges::find(pipelines_, mask.format, &Made::mask_format) == pipelines_.end()) {
        pipelines_.push_back({mask.format, makePipeline(mask.format, false), makePipeline(mask.format, true)});
    }
}

void ConvergePass::prepare(const Plan& plan, const ImageInfo& mask, const MaskShape&)
{
    warmUp({.format = mask.format});
    lights_.resize(std::max(lights_.size(), plan.lights.size()));
    if (!history_.prepare(mask)) {
        return;
    }
    device_.retire(std::move(target_));
    ImageInfo info = mask;
    info.format = targetFormat(mask.format);
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    info.purpose = "mask of one frame";
    target_ = Image(device_, info);
    for (Slot& slot : slots_) {
        device_.retire(std::move(slot.layers));
        slot.layers = HostBuffer(device_, info.layers * sizeof(shared::GpuConverge), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 "what converges");
    }
    forget();
}

VkFormat ConvergePass::targetFormat(VkFormat mask_format)
{
    return MaskHistory::visibilityFormat(kHistory, mask_format);
}

void ConvergePass::writeSet(const Slot& slot, const MaskJob& job)
{
    const MaskInputs& inputs = job.inputs;
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = sampler_.get();
    const bool has_normals = inputs.normal != VK_NULL_HANDLE;
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kConstants, job.constants, sizeof(shared::GpuConstants)),
        DescriptorSets::buffer(kLayers, slot.layers.buffer()),
        DescriptorSets::image(kDepth, sampler, inputs.depth, inputs.depth_layout),
        DescriptorSets::image(kNormal, sampler, has_normals ? inputs.normal : inputs.depth,
                              has_normals ? kRead : inputs.depth_layout),
        DescriptorSets::image(kNow, sampler, target_.view(), kRead),
        DescriptorSets::image(kMean, sampler, history_.before().visibility.view(), kRead),
        DescriptorSets::image(kSurface, sampler, history_.before().surfaces.view(), kRead)};
    sets_.write(slot.sets[history_.turn()], writes);
}

/// Is the frame before that of the plan before, or of this plan itself?
bool ConvergePass::goesOn(const Plan& plan) const
{
    return isAgain(plan) || (!plan.cut && planner_ == plan.planner && number_ + 1 == plan.number);
}

std::uint32_t ConvergePass::stood(const Plan& plan) const
{
    bool stands = goesOn(plan) && history_.stands(plan) && plan.moved_ws.empty();
    for (std::size_t i = 0; stands && i < plan.lights.size(); ++i) {
        const Light& before = lights_[i].light;
        const Light& now = plan.made_for.lights[i];
        stands = !lights_[i].known || (isSameLight(before, now) && moveOf(before, now) == 0.0);
    }
    return stands ? stood_ + 1 : 0;
}

/// A frame's moment once more, seen from elsewhere: it shows the mean that the frame is part of, and adds nothing.
bool ConvergePass::isAgain(const Plan& plan) const
{
    return planner_ == plan.planner && number_ == plan.number;
}

void ConvergePass::fillLight(const Plan& plan, std::size_t index, std::uint32_t stood_frames,
                             shared::GpuConverge& out) const
{
    const LightPlan& planned = plan.lights[index];
    const Light& light = plan.made_for.lights[index];
    const LightBefore& before = lights_[index];
    if (!pack::joinsFrames(planned) || !before.known || !isSameLight(before.light, light) ||
        before.place != maskPlaceOf(planned)) {
        return;
    }
    const double move = moveOf(before.light, light);
    const bool parallel = light.type == LightType::directional;
    const glm::dvec3 to_light = light.position_ws - plan.made_for.camera.eye_ws;
    const double size = parallel ? std::tan(0.5 * light.angular_diameter_rad) : light.radius_m;
    const bool whole = (*plan.options)[planned.options].integratesLight();
    const float power = shared::confidencePower(static_cast<float>(stood_frames),
                                                whole ? shared::kMostOfWholeLight : shared::kMostOfPoint);
    const float most = move > 0.0 ? std::min(kMostAtRest, static_cast<float>(std::floor(1.0 / move))) : kMostAtRest;
    const auto pad = static_cast<float>(padOf(plan, planned, to_light));
    const glm::vec4 place = parallel ? glm::vec4(glm::vec3(-glm::normalize(light.direction_ws)), 0.0F)
                                     : glm::vec4(glm::vec3(to_light), 1.0F);
    for (int channel = 0; channel < 4; ++channel) {
        if ((maskChannelsOf(planned) >> channel & 1U) != 0) {
            out.most[channel] = most;
            out.place[channel] = place;
            out.size[channel] = static_cast<float>(size);
            out.pad[channel] = pad;
            out.power[channel] = power;
            out.least[channel] = whole ? shared::kLeastOfWholeLight : shared::kLeastOfPoint;
        }
    }
}

/// Returns whether the camera stands and nothing moved.
bool ConvergePass::fill(const Slot& slot, const Plan& plan, bool has_normals)
{
    static_assert(shared::kMovedBoxes == static_cast<int>(kMostMoved));
    const std::span layers(static_cast<shared::GpuConverge*>(slot.layers.data()), target_.info().layers);
    std::ranges::fill(layers, shared::GpuConverge{});
    if (!goesOn(plan)) {
        return false;
    }
    const bool still = history_.stands(plan);
    const Reprojection before = history_.reprojection(plan);
    for (shared::GpuConverge& layer : layers) {
        layer.before_x = before.x;
        layer.before_y = before.y;
        layer.before_w = before.w;
        layer.before_eye = before.eye;
        layer.state = {plan.moved_ws.size(), still ? 1U : 0U, 0U, has_normals && had_normals_ ? 1U : 0U};
        for (std::size_t i = 0; i < plan.moved_ws.size(); ++i) {
            const Aabb& box = plan.moved_ws[i];
            layer.box[2 * i] =
                glm::dvec4((glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5 - plan.made_for.camera.eye_ws, 0.0);
            layer.box[2 * i + 1] = glm::dvec4((glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5, 0.0);
        }
    }
    const std::uint32_t stood_frames = stood(plan); // looks at all lights
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        fillLight(plan, i, stood_frames, layers[plan.lights[i].mask_layer]);
    }
    return still && plan.moved_ws.empty();
}

void ConvergePass::remember(const Plan& plan, bool has_normals)
{
    stood_ = stood(plan);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        lights_[i].known = i < plan.lights.size() && pack::joinsFrames(plan.lights[i]);
        if (lights_[i].known) {
            lights_[i].light = plan.made_for.lights[i];
            lights_[i].place = maskPlaceOf(plan.lights[i]);
        }
    }
    planner_ = plan.planner;
    number_ = plan.number;
    had_normals_ = has_normals;
}

void ConvergePass::recordLayer(VkCommandBuffer commands, std::uint32_t layer, const Image& mask)
{
    beginJoining(
        device_, commands, mask.info().extent,
        std::array{mask.layer(layer), history_.now().visibility.layer(layer), history_.now().surfaces.layer(layer)});
    const auto number = static_cast<std::int32_t>(layer);
    device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof number, &number);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
    device_.vk.CmdEndRendering(commands);
}

void ConvergePass::record(const MaskJob& job, const Image& mask)
{
    const VkCommandBuffer commands = job.commands;
    const Plan& plan = job.plan;
    const Slot& slot = slots_[job.slot];
    const bool has_normals = job.inputs.normal != VK_NULL_HANDLE;
    writeSet(slot, job);
    const bool at_rest = fill(slot, plan, has_normals);
    const VkDescriptorSet set = slot.sets[history_.turn()];
    history_.begin(commands);
    device_.beginLabel(commands, "converge");
    const auto made = std::ranges::find(pipelines_, mask.info().format, &Made::mask_format);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                               at_rest ? made->at_rest.get() : made->moving.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    for (std::uint32_t layer = 0; layer < mask.info().layers; ++layer) {
        recordLayer(commands, layer, mask);
    }
    device_.endLabel(commands);
    if (isAgain(plan)) {
        history_.drop();
        return;
    }
    remember(plan, has_normals);
    history_.end(commands, plan);
}

} // namespace gnomon::vulkan
