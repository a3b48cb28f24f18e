// SPDX-License-Identifier: Apache-2.0
// Based on: A. Lauritzen, M. Salvi, A. Lefohn, "Sample Distribution Shadow Maps", I3D 2011: the depths that are there
// are divided among cascades, and each is fitted to the pixels that it serves.
#include "cascade_fitter.h"

#include "barriers.h"

#include <gnomon/pack/cascade_lights.h>

#include <gnomon/shared/gpu_structs.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kVertex =
    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr VkPipelineStageFlags2 kClear = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

} // namespace

CascadeFitter::CascadeFitter(Device& device, std::uint32_t slots, VkPipelineCache cache)
    : device_(device), slot_count_(slots), cache_(cache)
{
}

void CascadeFitter::warmUp()
{
    if (!complete_) {
        makePipelines();
        makeSets();
    }
}

void CascadeFitter::prepare(const Plan& plan)
{
    const std::uint32_t lights = pack::cascadeLightCount(plan);
    if (lights == 0) {
        return;
    }
    warmUp();
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

void CascadeFitter::dispatch(VkCommandBuffer commands, Pass pass, const glm::uvec3& groups) const
{
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, passes_[pass].get());
    device_.vk.CmdDispatch(commands, groups.x, groups.y, groups.z);
}

void CascadeFitter::record(VkCommandBuffer commands, std::uint32_t slot_index, const Plan& plan,
                           const MaskInputs& inputs)
{
    assert(slot_index < slots_.size() && inputs.depth != VK_NULL_HANDLE);
    Slot& slot = slots_[slot_index];
    no_ids_.makeReadable(device_, commands);
    writeFitSet(slot, inputs);
    const glm::uvec2 screen_px(inputs.extent.width, inputs.extent.height);
    auto* const described = static_cast<shared::GpuCascadeLight*>(slot.lights.data());
    const std::uint32_t lights =
        pack::fillCascadeLights(plan, screen_px, {described, slot.lights.size() / sizeof *described});
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
    const glm::uvec3 pixels(pack::groupsOver(screen_px), lights);
    dispatch(commands, ids ? kDepthIdsPass : kDepthPass, pixels);
    wait({kCompute, kWrite, kCompute, kRead | kWrite});
    dispatch(commands, ids ? kBoundsIdsPass : kBoundsPass, pixels);
    wait({kCompute, kWrite, kCompute, kRead | kWrite});
    dispatch(commands, kFinishPass, {1, 1, lights});
    wait({kCompute, kWrite, kVertex | kCompute | VK_PIPELINE_STAGE_2_HOST_BIT,
          VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | kRead | VK_ACCESS_2_HOST_READ_BIT});
}

bool CascadeFitter::fits(const Plan& plan)
{
    return pack::cascadeLightCount(plan) > 0;
}

bool CascadeFitter::isFitted(const Plan& plan) const
{
    return !fits(plan) || fitted_frame_ == plan.frame;
}

void CascadeFitter::recordViews(VkCommandBuffer commands, std::uint32_t slot_index, Reader reader, const Views& views)
{
    const VkDescriptorSet set = slots_[slot_index].complete[static_cast<std::size_t>(reader)];
    const std::array writes{
        DescriptorSets::buffer(0, views_.buffer()),
        DescriptorSets::buffer(1, views.buffer, views.count * sizeof(shared::GpuView), views.offset)};
    complete_sets_.write(set, writes);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, complete_.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, complete_layout_.get(), 0, 1, &set, 0,
                                     nullptr);
    constexpr auto kGroup = static_cast<std::uint32_t>(shared::kCompleteGroup);
    device_.vk.CmdDispatch(commands, (views.count + kGroup - 1) / kGroup, 1, 1);
    recordBarrier(device_, commands,
                  MemoryBarrier{kCompute, kWrite, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | kCompute,
                                kRead | VK_ACCESS_2_UNIFORM_READ_BIT});
}

std::vector<FittedView> CascadeFitter::read(std::uint32_t slot) const
{
    std::vector<FittedView> views;
    if (slot < slots_.size()) {
        const auto* const report = static_cast<const shared::GpuFittedView*>(slots_[slot].report.data());
        for (std::uint32_t i = 0; i < slots_[slot].view_count; ++i) {
            views.push_back(pack::describeFitted(report[i]));
        }
    }
    return views;
}

} // namespace gnomon::vulkan
