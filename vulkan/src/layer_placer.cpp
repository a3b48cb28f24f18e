// SPDX-License-Identifier: Apache-2.0
#include "layer_placer.h"

#include "barriers.h"
#include "optional_parts.h"

#include <gnomon/pack/depth_layers.h>
#include <gnomon/plan_views.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gnomon/shared/depth_layers.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

int depthFlags(const ResolvedOptions& options)
{
    return options.metric() == DepthMetricKind::z_over_w ? shared::kMomentZOverW : 0;
}

float nearOverFar(const View& view, const DepthMetric& metric)
{
    return view.projection.parallel ? 1.0F : static_cast<float>(metric.near_m / metric.far_m);
}

/// Takes depths of one metric to those of a view's, exactly in the middle of the view's map: both may measure along
/// slightly different directions. x: factor, y: summand.
glm::dvec2 carryOver(const DepthMetric& from, const View& view)
{
    const glm::dvec4& row = view.projection.metric.metric_ws;
    const glm::dvec3 axis = glm::dvec3(row) / glm::dot(glm::dvec3(row), glm::dvec3(row));
    const double start = glm::dot(row, glm::dvec4(view.projection.light_place_ws, 1.0));
    const glm::dvec3 middle_ws = view.projection.light_place_ws + axis * (0.5 - start);
    const double factor = (from.far_m - from.near_m) / (view.projection.metric.far_m - view.projection.metric.near_m);
    return {factor, 0.5 - factor * glm::dot(from.metric_ws, glm::dvec4(middle_ws, 1.0))};
}

// Layers that are new have all the steps that they need; those that were there go half way to where they would be in
// each of a few steps, so that what changes of a sudden does not show of a sudden. Where a motion holds maps still,
// they stay until they are off, because whatever light bleeds within a layer would follow them. Then they go all the
// way: such a map may not be drawn again for long.
constexpr int kFirstSteps = 256;
constexpr int kLaterSteps = 2;
constexpr float kLaterShare = 0.5F;

} // namespace

LayerPlacer::LayerPlacer(Device& device, const ResolvedOptions& options, VkPipelineCache cache)
    : device_(device), options_(options), of_world_(hasWorldLayers(options.filter(), options.moments()))
{
    if (options.filter() == Filter::lvsm && followsDepths(options.moments().placement)) {
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
    const bool placed = (passes_ || of_world_) &&
                        std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.metric; });
    if (placed && !outgrown_) {
        outgrown_ = std::move(buffer_);
    } else {
        device_.retire(std::move(buffer_));
    }
    buffer_ = std::move(larger);
    slots_.resize(slots);
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
    const bool grows = need > slots_.size();
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

shared::GpuHistogramPush LayerPlacer::histogramPush(const View& view) const
{
    const Tile& tile = view.place.tile;
    const auto side = static_cast<int>(std::max(tile.width, tile.height));
    shared::GpuHistogramPush push;
    push.tile = {0, 0, tile.width, tile.height};
    const MomentOptions& moments = options_.moments();
    const int most = moments.placement == LayerPlacement::gaps ? shared::kMostPairsAlong : shared::kMostSamplesAlong;
    const auto reach = static_cast<int>(blurRadius(moments)) / 2 + 1;
    push.more = {(side + most - 1) / most, depthFlags(options_), reach, 0};
    push.metric = {nearOverFar(view, view.projection.metric), 0.0F, 0.0F, 0.0F};
    return push;
}

shared::GpuPlacePush LayerPlacer::placePush(const View& view, std::uint32_t index, bool held) const
{
    const Slot& slot = slots_[index];
    const bool anew = !slot.metric || slot.map != view.place.map || (!view.place.map && slot.light != view.light);
    const DepthMetric& before = anew ? view.projection.metric : *slot.metric;
    const glm::dvec2 carry = carryOver(before, view);
    shared::GpuPlacePush push;
    const bool to_rest = anew || held;
    push.slot = {index, options_.moments().layers, to_rest ? kFirstSteps : kLaterSteps, depthFlags(options_)};
    push.how = {options_.moments().layer_overlap, to_rest ? 1.0F : kLaterShare, anew ? 1.0F : 0.0F,
                held && !anew ? 1.0F : 0.0F};
    push.carry = {carry.x, carry.y, nearOverFar(view, before), nearOverFar(view, view.projection.metric)};
    return push;
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
    if (!passes_ && !of_world_) {
        return;
    }
    const View& view = plan.views[view_index];
    const std::uint32_t index = slotOf(plan, view_index);
    assert(index < slots_.size());
    if (of_world_) {
        write(commands, view, index);
    } else {
        const Technique& technique = optionsOf(plan, view).technique();
        const bool held = technique.motion != Motion::free || technique.fit == Fit::scene;
        passes_->record(commands, {histogramPush(view), placePush(view, index, held)});
    }
    slots_[index].map = view.place.map;
    slots_[index].light = view.light;
    slots_[index].metric = view.projection.metric;
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
    if (options_.filter() != Filter::lvsm || slot >= slots_.size()) {
        return {};
    }
    return pack::describeLayers(entries()[slot], options_.moments());
}

} // namespace gnomon::vulkan
