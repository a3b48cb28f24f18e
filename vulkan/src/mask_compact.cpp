// SPDX-License-Identifier: Apache-2.0
// The part of the mask pass that differs for a compact mask.
#include "mask_pass.h"
#include "usage.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/soften_draws.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <cstring>

namespace gnomon::vulkan {

const pack::CompactMaskRule& checkedRule(const pack::CompactMaskRule& rule)
{
    if (const char* const wrong = pack::wrongOf(rule)) {
        refuseUse("make a renderer with a compact mask", wrong, "choose others");
    }
    return rule;
}

void MaskPassRecorder::checkCompact(const Plan& plan) const
{
    if (!isCompact()) {
        return;
    }
    constexpr const char* kTried = "prepare a compact mask";
    constexpr const char* kInstead = "let each light have a channel of its own (compact.channels 0)";
    for (const LightPlan& light : plan.lights) {
        if (light.mask_coloured) {
            refuseUse(kTried, "a light in colour needs four channels (translucent=colour)", kInstead);
        }
        if (light.steps.paired) {
            refuseUse(kTried, "a sun that moves in steps is seen from two positions, and a tile has room for one",
                      kInstead);
        }
        if (light.volume_count > 0) {
            refuseUse(kTried, "volumes are counted light by light, each into a channel of its own (filter=volumes)",
                      kInstead);
        }
        if (pack::joinsFrames(light)) {
            refuseUse(kTried, "frames converge light by light, and a channel has another light in the next frame",
                      kInstead);
        }
        if (pack::halvesMask(plan, light)) {
            refuseUse(kTried,
                      "of a mask of half the size pixels take from those beside, whose tile has other lights in its "
                      "channels (mask-size=half)",
                      kInstead);
        }
        if (pack::softens(plan, light)) {
            refuseUse(kTried,
                      "a blur of the mask takes from pixels beside, whose tile has other lights in its channels",
                      kInstead);
        }
    }
    if (plan.lights.size() > pack::kMostTileLights) {
        refuseUse(kTried, "there are more than 65535 lights", kInstead);
    }
}

std::uint32_t MaskPassRecorder::layersFor(const Plan& plan) const
{
    return isCompact() ? compact_.channels / shared::kLightsPerLayer : std::max(plan.mask_layers, 1U);
}

std::uint32_t MaskPassRecorder::channelsFor(const Plan& plan) const
{
    return isCompact() ? shared::kLightsPerLayer : maskChannelCount(plan);
}

std::uint32_t MaskPassRecorder::lightRoomFor(const Plan& plan) const
{
    return isCompact() ? std::max(static_cast<std::uint32_t>(plan.lights.size()), 1U) : pack::maskLightCount(plan);
}

void MaskPassRecorder::describeTiles(const Plan& plan, glm::uvec2 size_px)
{
    pack::listCompactMask(plan, compact_, size_px, lists_, tiles_);
    now_.tiles.resize(pack::maskTileWords(tiles_));
    pack::fillMaskTiles(tiles_, now_.tiles);
}

void MaskPassRecorder::makeRoomForTiles(Slot& slot)
{
    const VkDeviceSize bytes = now_.tiles.size() * sizeof(glm::uvec2);
    if (slot.tiles.size() < bytes) {
        device_.retire(std::move(slot.tiles));
        // With room for a while: the lists change from frame to frame.
        slot.tiles = HostBuffer(device_, bytes + bytes / 2, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "mask tiles");
    }
}

void MaskPassRecorder::fillTiles(Slot& slot)
{
    makeRoomForTiles(slot);
    std::memcpy(slot.tiles.data(), now_.tiles.data(), now_.tiles.size() * sizeof(glm::uvec2));
    slot.tiles_of = drawings_;
}

BufferRef MaskPassRecorder::tiles(std::uint32_t slot) const
{
    const bool has = isCompact() && slot < slots_.size() && slots_[slot].tiles.buffer() != VK_NULL_HANDLE;
    return has ? BufferRef{slots_[slot].tiles.buffer(), slots_[slot].tiles.size()} : BufferRef{};
}

} // namespace gnomon::vulkan
