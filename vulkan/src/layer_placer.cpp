// SPDX-License-Identifier: Apache-2.0
#include "layer_placer.h"

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

bool isSame(const Tile& a, const Tile& b)
{
    return a.layer == b.layer && a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

/// What the placements that look at nothing say of every view.
shared::GpuDepthLayers fixedLayers(const MomentOptions& options)
{
    const auto count = static_cast<int>(options.layers);
    const auto begins = [&](int i) {
        if (i <= 0 || i >= count) {
            return i <= 0 ? 0.0F : 1.0F;
        }
        return options.placement == LayerPlacement::by_hand ? options.splits[static_cast<std::size_t>(i) - 1]
                                                            : static_cast<float>(i) / static_cast<float>(count);
    };
    shared::GpuDepthLayers layers{};
    for (int i = 0; i < shared::kDepthLayers; ++i) {
        const float reach = (begins(i + 1) - begins(i)) * options.layer_overlap;
        const float near = i == 0 ? 0.0F : std::max(begins(i) - reach, 0.0F);
        const float far = i + 1 == count ? 1.0F : std::min(begins(i + 1) + reach, 1.0F);
        layers.layer[i] = i < count ? glm::vec4(near, far, begins(i), 0.5F * (begins(i) + begins(i + 1)))
                                    : glm::vec4(0.0F, 1.0F, 2.0F, 0.0F);
    }
    return layers;
}

} // namespace

LayerPlacer::LayerPlacer(Device& device, const FilterOptions& filter, [[maybe_unused]] VkPipelineCache cache)
    : device_(device), filter_(filter)
{
    makeBuffer(1);
}

void LayerPlacer::makeBuffer(std::uint32_t slots)
{
    buffer_ = {};
    buffer_ =
        HostBuffer(device_, slots * sizeof(shared::GpuDepthLayers), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "depth layers");
    slots_.assign(slots, {});
    std::fill_n(entries(), slots, fixedLayers(filter_.moments));
}

shared::GpuDepthLayers* LayerPlacer::entries() const
{
    return static_cast<shared::GpuDepthLayers*>(buffer_.data());
}

std::uint32_t LayerPlacer::findSlot(const Tile& tile) const
{
    const auto same =
        std::find_if(slots_.begin(), slots_.end(), [&](const Slot& s) { return s.taken && isSame(s.tile, tile); });
    const auto found = same != slots_.end()
                           ? same
                           : std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.taken; });
    return found == slots_.end() ? kNoIndex : static_cast<std::uint32_t>(found - slots_.begin());
}

bool LayerPlacer::prepare(const Plan& plan)
{
    if (filter_.filter != Filter::lvsm) {
        return false;
    }
    const bool grows = plan.views.size() > slots_.size();
    if (grows) {
        makeBuffer(static_cast<std::uint32_t>(plan.views.size()));
    }
    for (Slot& slot : slots_) {
        slot.taken = slot.taken && std::any_of(plan.views.begin(), plan.views.end(),
                                               [&](const View& view) { return isSame(view.tile, slot.tile); });
    }
    slot_of_view_.clear();
    for (const View& view : plan.views) {
        const std::uint32_t slot = findSlot(view.tile);
        assert(slot != kNoIndex); // a slot that is taken is some view's, and there are as many as views
        slots_[slot] = {true, view.tile};
        slot_of_view_.push_back(slot);
    }
    return grows;
}

void LayerPlacer::forgetDepth() {}

std::uint32_t LayerPlacer::slotOf(std::uint32_t view) const
{
    return filter_.filter == Filter::lvsm ? slot_of_view_[view] : 0;
}

void LayerPlacer::record([[maybe_unused]] VkCommandBuffer commands, [[maybe_unused]] const Plan& plan,
                         [[maybe_unused]] std::uint32_t view, [[maybe_unused]] VkImageView depth)
{
}

VkBuffer LayerPlacer::buffer() const
{
    return buffer_.buffer();
}

VkDeviceSize LayerPlacer::bytes() const
{
    return buffer_.size();
}

std::vector<DepthLayer> LayerPlacer::read(std::uint32_t view) const
{
    if (filter_.filter != Filter::lvsm || view >= slot_of_view_.size()) {
        return {};
    }
    std::vector<DepthLayer> layers;
    for (std::uint32_t i = 0; i < filter_.moments.layers; ++i) {
        const glm::vec4& layer = entries()[slot_of_view_[view]].layer[i];
        layers.push_back({layer.x, layer.y, layer.z});
    }
    return layers;
}

} // namespace gnomon::vulkan
