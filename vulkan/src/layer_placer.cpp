// SPDX-License-Identifier: Apache-2.0
#include "layer_placer.h"

#include "barriers.h"
#include "optional_parts.h"

#include <gnomon/pack/depth_layers.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/depth_layers.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
LayerPlacer::LayerPlacer(Device& device, const ResolvedOptions& options, VkPipelineCache cache)
    : device_(device), options_(options), steps_(options)
{
    if (steps_.finds()) {
        requireLargeGroups(device, "find layers of lvsm");
        passes_.emplace(device, options, cache);
    }
    makeBuffer(1);
}

void LayerPlacer::makeBuffer(std::uint32_t slots)
{
    constexpr VkBufferUsageFlags kUsage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    HostBuffer larger(device_, slots * sizeof(shared::GpuDepthLayers), kUsage, "depth layers");
    const bool placed = steps_.resize(slots);
    if (placed && !outgrown_) {
        outgrown_ = std::move(buffer_);
    } else {
        device_.retire(std::move(buffer_));
    }
    buffer_ = std::move(larger);
    slots_ = slots;
    std::fill_n(entries(), slots, pack::firstDepthLayers(options_.moments()));
}

shared::GpuDepthLayers* LayerPlacer::entries() const
{
    return static_cast<shared::GpuDepthLayers*>(buffer_.data());
}

bool LayerPlacer::prepare(const Plan& plan)
{
    if (options_.filter() != Filter::lvsm) {
        return false;
    }
    if (copied_) {
        device_.retire(std::move(outgrown_));
        copied_ = false;
    }
    const std::uint32_t need = pack::depthLayersCount(plan);
    const bool grows = need > slots_;
    if (grows) {
        makeBuffer(need);
    }
    return grows;
}

void LayerPlacer::setDepth(VkImageView depth)
{
    if (passes_) {
        passes_->setImages(depth, buffer_.buffer());
    }
}

void LayerPlacer::copyOutgrown(VkCommandBuffer commands)
{
    if (!outgrown_ || copied_) {
        return;
    }
    constexpr VkPipelineStageFlags2 kShaders =
        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kCopy = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    recordBarrier(device_, commands,
                  MemoryBarrier{kShaders, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kCopy, VK_ACCESS_2_TRANSFER_READ_BIT});
    const VkBufferCopy all{0, 0, outgrown_.size()};
    device_.vk.CmdCopyBuffer(commands, outgrown_.buffer(), buffer_.buffer(), 1, &all);
    recordBarrier(device_, commands,
                  MemoryBarrier{kCopy, VK_ACCESS_2_TRANSFER_WRITE_BIT, kShaders | VK_PIPELINE_STAGE_2_HOST_BIT,
                                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                                    VK_ACCESS_2_HOST_READ_BIT});
    copied_ = true;
}

std::uint32_t LayerPlacer::slotOf(const Plan& plan, std::uint32_t view) const
{
    return options_.filter() == Filter::lvsm ? pack::depthLayersSlot(plan, view) : 0;
}

/// Into the buffer in the order of the commands, because what was recorded before reads what was there before.
void LayerPlacer::write(VkCommandBuffer commands, const View& view, std::uint32_t slot)
{
    constexpr VkPipelineStageFlags2 kShaders =
        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kCopy = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    const shared::GpuDepthLayers layers = pack::worldDepthLayers(view, options_.moments());
    recordBarrier(
        device_, commands,
        MemoryBarrier{kShaders | kCopy, VK_ACCESS_2_TRANSFER_WRITE_BIT, kCopy, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    device_.vk.CmdUpdateBuffer(commands, buffer_.buffer(), slot * sizeof(layers), sizeof(layers), &layers);
    recordBarrier(device_, commands,
                  MemoryBarrier{kCopy, VK_ACCESS_2_TRANSFER_WRITE_BIT, kShaders | VK_PIPELINE_STAGE_2_HOST_BIT,
                                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_HOST_READ_BIT});
}

void LayerPlacer::record(VkCommandBuffer commands, const Plan& plan, std::uint32_t view_index)
{
    if (!passes_ && !steps_.areOfWorld()) {
        return;
    }
    const View& view = plan.views[view_index];
    const std::uint32_t index = slotOf(plan, view_index);
    assert(index < slots_);
    if (passes_) {
        passes_->record(commands, {steps_.histogram(view), steps_.place(optionsOf(plan, view), view, index)});
    } else {
        write(commands, view, index);
    }
    steps_.note(view, index);
}

VkBuffer LayerPlacer::buffer() const
{
    return buffer_.buffer();
}

VkDeviceSize LayerPlacer::bytes() const
{
    return buffer_.size();
}

std::vector<pack::DepthLayer> LayerPlacer::read(std::uint32_t slot) const
{
    if (options_.filter() != Filter::lvsm || slot >= slots_) {
        return {};
    }
    return pack::describeLayers(entries()[slot], options_.moments());
}

} // namespace gnomon::vulkan
