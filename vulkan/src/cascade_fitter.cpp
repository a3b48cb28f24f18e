// SPDX-License-Identifier: Apache-2.0
// Based on: A. Lauritzen, M. Salvi, A. Lefohn, "Sample Distribution Shadow Maps", I3D 2011: the depths that are there
// are divided among cascades, and each is fitted to the pixels that it serves.
#include "cascade_fitter.h"

#include "barriers.h"

#include <gpu_structs.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::vulkan {
namespace {

static_assert(shared::kMostCascades == static_cast<int>(kMaxCascades));

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kVertex =
    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr VkPipelineStageFlags2 kClear = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

bool isFirst(const View& view)
{
    return view.gpu_cascade == 0;
}

std::uint32_t lightsOf(const Plan& plan)
{
    return static_cast<std::uint32_t>(std::count_if(plan.views.begin(), plan.views.end(), isFirst));
}

glm::uvec2 groupsOver(VkExtent2D extent)
{
    constexpr std::uint32_t kSide = 2 * shared::kBoundsGroup;
    return {(extent.width + kSide - 1) / kSide, (extent.height + kSide - 1) / kSide};
}

/// The light that the base map `view`, the plan's view `index`, belongs to.
shared::GpuCascadeLight describe(const Frame& frame, const Plan& plan, std::uint32_t index, VkExtent2D screen,
                                 double margin_texels)
{
    const View& view = plan.views[index];
    const Camera& camera = frame.camera;
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), camera.eye_ws);
    const glm::dmat4 eye_from_ndc = glm::inverse(camera.clip_from_world * world_from_eye);
    const glm::dmat4 base_from_eye = view.clip_from_world * world_from_eye;
    const CascadeOptions& cascades = plan.cascades;
    const glm::dvec2 texels(view.tile.width, view.tile.height);
    const glm::dvec2 widen = texels / (texels - 2.0 * plan.border_texels);
    const glm::dvec2 inside = 1.0 - 2.0 * margin_texels / texels;
    constexpr double kAnywhere_m = 1e18;
    const bool perspective = glm::length(glm::dvec3(glm::row(camera.clip_from_world, 3))) > 0.0;

    shared::GpuCascadeLight light;
    light.eye_x = glm::row(eye_from_ndc, 0);
    light.eye_y = glm::row(eye_from_ndc, 1);
    light.eye_z = glm::row(eye_from_ndc, 2);
    light.eye_w = glm::row(eye_from_ndc, 3);
    light.view_axis = glm::vec4(glm::vec3(view.slice.axis), 0.0F);
    const glm::vec2 size(screen.width, screen.height);
    light.screen = {size, 1.0F / size};
    light.base_x = glm::row(base_from_eye, 0);
    light.base_y = glm::row(base_from_eye, 1);
    light.base_w = glm::row(base_from_eye, 3);
    light.reach = glm::dvec4(camera.reversed_z ? 0.0 : 1.0, plan.fade_end_m > 0.0 ? plan.fade_end_m : kAnywhere_m,
                             inside.x, inside.y);
    light.split = glm::dvec4(cascades.lambda, cascades.blend, widen.x, widen.y);
    light.cascades = {cascades.count, index, cascades.explicitEnds() ? 1U : 0U, perspective ? 1U : 0U};
    const auto& ends = cascades.ends_m;
    light.ends[0] = glm::dvec4(ends[0], ends[1], ends[2], ends[3]);
    light.ends[1] = glm::dvec4(ends[4], 0.0, 0.0, 0.0);
    light.texel = glm::dvec4(view.texel_xy_m, 0.0, 0.0);
    return light;
}

FittedView described(const shared::GpuFittedView& gpu)
{
    constexpr float kEndless = 1e30F;
    FittedView view;
    view.scale = glm::dvec2(gpu.place.x, gpu.place.y);
    view.centre = glm::dvec2(gpu.place.z, gpu.place.w);
    if (gpu.slice.x > -kEndless) {
        view.begin_m = gpu.slice.x;
    }
    if (gpu.slice.y < kEndless) {
        view.end_m = gpu.slice.y;
    }
    view.blend_m = gpu.slice.z > 0.0F ? 1.0 / gpu.slice.z : 0.0;
    view.seen_low = glm::dvec2(gpu.seen.x, gpu.seen.y);
    view.seen_high = glm::dvec2(gpu.seen.z, gpu.seen.w);
    return view;
}

} // namespace

CascadeFitter::CascadeFitter(Device& device, const ShadowRendererOptions& options)
    : device_(device), reach_texels_(filterReachTexels(options.filter)), slot_count_(options.frames_in_flight),
      cache_(options.pipeline_cache)
{
}

void CascadeFitter::prepare(const Plan& plan)
{
    const std::uint32_t lights = lightsOf(plan);
    if (lights == 0) {
        return;
    }
    if (!complete_) {
        makePipelines();
        makeSets();
    }
    const auto views = static_cast<std::uint32_t>(plan.views.size());
    if (views_.size() < views * sizeof(shared::GpuFittedView) ||
        keys_.size() < lights * sizeof(shared::GpuCascadeKeys)) {
        makeBuffers(views, lights);
    }
}

void CascadeFitter::makeBuffers(std::uint32_t views, std::uint32_t lights)
{
    constexpr const char* kPurpose = "cascade bounds";
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkDeviceSize view_bytes = views * sizeof(shared::GpuFittedView);
    device_.retire(std::move(keys_));
    device_.retire(std::move(views_));
    keys_ = DeviceBuffer(device_, lights * sizeof(shared::GpuCascadeKeys), kStorage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         kPurpose);
    views_ = DeviceBuffer(device_, view_bytes, kStorage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, kPurpose);
    for (Slot& slot : slots_) {
        device_.retire(std::move(slot.lights));
        device_.retire(std::move(slot.report));
        slot.lights = HostBuffer(device_, lights * sizeof(shared::GpuCascadeLight), kStorage, kPurpose);
        slot.report = HostBuffer(device_, view_bytes, kStorage, kPurpose);
        slot.view_count = 0;
    }
}

std::uint32_t CascadeFitter::fillLights(Slot& slot, const Frame& frame, const Plan& plan,
                                        const MaskInputs& inputs) const
{
    auto* const out = static_cast<shared::GpuCascadeLight*>(slot.lights.data());
    const double margin = tileMarginTexels(static_cast<double>(reach_texels_));
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        if (isFirst(plan.views[i])) {
            assert((count + 1) * sizeof *out <= slot.lights.size());
            out[count++] = describe(frame, plan, i, inputs.extent, margin);
        }
    }
    return count;
}

void CascadeFitter::dispatch(VkCommandBuffer commands, Pass pass, const glm::uvec3& groups) const
{
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, passes_[pass].get());
    device_.vk.CmdDispatch(commands, groups.x, groups.y, groups.z);
}

void CascadeFitter::record(VkCommandBuffer commands, std::uint32_t slot_index, const Frame& frame, const Plan& plan,
                           const MaskInputs& inputs)
{
    assert(slot_index < slots_.size() && inputs.depth != VK_NULL_HANDLE);
    Slot& slot = slots_[slot_index];
    writeFitSet(slot, inputs);
    const std::uint32_t lights = fillLights(slot, frame, plan, inputs);
    slot.view_count = static_cast<std::uint32_t>(plan.views.size());
    fitted_frame_ = plan.frame;

    const auto wait = [&](const MemoryBarrier& barrier) {
        recordBarrier(device_, commands, barrier);
    };
    // The last frame's maps and mask come first.
    wait({kCompute | kVertex, kWrite, kClear | kCompute, VK_ACCESS_2_TRANSFER_WRITE_BIT | kRead | kWrite});
    device_.vk.CmdFillBuffer(commands, keys_.buffer(), 0, VK_WHOLE_SIZE, 0);
    wait({kClear, VK_ACCESS_2_TRANSFER_WRITE_BIT, kCompute, kRead | kWrite});
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, fit_layout_.get(), 0, 1, &slot.fit, 0,
                                     nullptr);
    const bool ids = inputs.object_id != VK_NULL_HANDLE;
    const glm::uvec3 pixels(groupsOver(inputs.extent), lights);
    dispatch(commands, ids ? kDepthIds : kDepth, pixels);
    wait({kCompute, kWrite, kCompute, kRead | kWrite});
    dispatch(commands, ids ? kBoundsIds : kBounds, pixels);
    wait({kCompute, kWrite, kCompute, kRead | kWrite});
    dispatch(commands, kFinish, {1, 1, lights});
    wait({kCompute, kWrite, kVertex | kCompute | VK_PIPELINE_STAGE_2_HOST_BIT,
          VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | kRead | VK_ACCESS_2_HOST_READ_BIT});
}

bool CascadeFitter::fits(const Plan& plan)
{
    return std::any_of(plan.views.begin(), plan.views.end(), isFirst);
}

bool CascadeFitter::isFitted(const Plan& plan) const
{
    return !fits(plan) || fitted_frame_ == plan.frame;
}

void CascadeFitter::recordConstants(VkCommandBuffer commands, std::uint32_t slot_index, const Buffer& buffer,
                                    VkDeviceSize offset, std::uint32_t count)
{
    const Slot& slot = slots_[slot_index];
    const std::array writes{DescriptorSets::buffer(0, views_.buffer()),
                            DescriptorSets::buffer(1, buffer.buffer(), count * sizeof(shared::GpuView), offset)};
    complete_sets_.write(slot.complete, writes);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, complete_.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, complete_layout_.get(), 0, 1,
                                     &slot.complete, 0, nullptr);
    constexpr auto kGroup = static_cast<std::uint32_t>(shared::kCompleteGroup);
    device_.vk.CmdDispatch(commands, (count + kGroup - 1) / kGroup, 1, 1);
    recordBarrier(
        device_, commands,
        MemoryBarrier{kCompute, kWrite, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, kRead | VK_ACCESS_2_UNIFORM_READ_BIT});
}

std::vector<FittedView> CascadeFitter::read(std::uint32_t slot) const
{
    std::vector<FittedView> views;
    if (slot < slots_.size()) {
        const auto* const report = static_cast<const shared::GpuFittedView*>(slots_[slot].report.data());
        for (std::uint32_t i = 0; i < slots_[slot].view_count; ++i) {
            views.push_back(described(report[i]));
        }
    }
    return views;
}

} // namespace gnomon::vulkan
