// SPDX-License-Identifier: Apache-2.0
// The source that the mask pass draws from, found before anything is recorded, and compared with the source of the
// present mask.
#include "mask_source.h"

#include "mask_pass.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/page_table.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {

bool hasVolumes(const Plan& plan)
{
    return std::ranges::any_of(plan.lights, [](const LightPlan& light) { return light.volume_count > 0; });
}

ContentNumber nameOfInputs(const Plan& plan, const MaskInputs& inputs)
{
    const bool goes_on = std::ranges::any_of(
        plan.lights, [](const LightPlan& light) { return pack::takesTurns(light) || pack::joinsFrames(light); });
    return goes_on || CascadeFitter::fits(plan) ? 0 : inputs.content;
}

namespace {

/// By how much a number of [-1, 1] is off at most that an image of this format holds.
float roundingOf(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_R32G32_SFLOAT:
        return 0.0F;
    case VK_FORMAT_R16G16_SNORM:
        return 0x1p-16F;
    case VK_FORMAT_R16G16_SFLOAT:
        return 0x1p-11F;
    default:
        return 0x1p-8F;
    }
}

/// Half a step of a depth buffer.
float depthRoundingOf(VkFormat format, bool reversed_z)
{
    switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D16_UNORM_S8_UINT:
        return 0x1p-17F;
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D24_UNORM_S8_UINT:
        return 0x1p-25F;
    default:
        return reversed_z ? 0.0F : 0x1p-25F;
    }
}

pack::DrawPrecision precisionOf(const Device& device, const MaskInputs& inputs, const Camera& camera)
{
    pack::DrawPrecision precision;
    precision.depth_rounding = depthRoundingOf(inputs.depth_format, camera.reversed_z);
    precision.sub_pixel_bits = device.subPixelBits();
    precision.normal_error_rad = inputs.normal != VK_NULL_HANDLE ? pack::normalError(roundingOf(inputs.normal_format))
                                                                 : pack::normalErrorFromDepth(precision.sub_pixel_bits);
    return precision;
}

} // namespace

void MaskPassRecorder::describe(const Plan& plan, const MaskInputs& inputs, const MapClasses& maps,
                                std::uint64_t map_changes)
{
    assert(plan.made_for.lights.size() == plan.lights.size() && plan.views.size() <= room_.views);
    shape_ =
        MaskShape{inputs.normal != VK_NULL_HANDLE, inputs.object_id != VK_NULL_HANDLE, inputs.smooth != VK_NULL_HANDLE};
    const glm::uvec2 size_px(inputs.extent.width, inputs.extent.height);
    const bool counts = hasVolumes(plan);
    now_.inputs = nameOfInputs(plan, inputs);
    now_.map_changes = map_changes;
    now_.options = plan.options;
    now_.shape = *shape_;
    now_.pieces = inputs.object_pieces;
    now_.objects = counts ? plan.made_for.objects : 0;
    now_.version = counts ? plan.made_for.version : 0;
    now_.camera = counts ? plan.made_for.camera : Camera{};
    now_.lights.clear();
    if (counts) {
        now_.lights = plan.made_for.lights;
    }
    if (isCompact()) {
        describeTiles(plan, size_px);
        pack::listCompactMaskDraws(plan, compact_, size_px, now_.draws);
    } else {
        pack::listMaskDraws(plan, size_px, now_.draws);
        pack::fillPageTable(plan, now_.tiles);
    }
    if (!now_.numbers.empty()) {
        pack::fillObjects(plan, now_.numbers);
    }
    describeConstants(plan, size_px, precisionOf(device_, inputs, plan.made_for.camera), maps);
}

void MaskPassRecorder::describeConstants(const Plan& plan, glm::uvec2 screen_px, const pack::DrawPrecision& precision,
                                         const MapClasses& maps)
{
    std::byte* const bytes = now_.constants.data();
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        map_images_[i] = {};
        if (maps[i]) {
            const ImageInfo& info = maps[i]->recorder->maps().info();
            map_images_[i] = {{info.extent.width, info.extent.height}, info.levels};
        }
        auto& constants = *reinterpret_cast<shared::GpuConstants*>(bytes + i * room_.constants_stride);
        pack::fillConstants(plan, i, screen_px, map_images_[i], precision, constants);
        if (drawsToConverge(plan) && weighsFrames((*plan.options)[i])) {
            constants.rule.moments.w = static_cast<std::int32_t>(converge_->stood(plan));
        }
    }
    const std::span lights(reinterpret_cast<shared::GpuLight*>(bytes + room_.lights_at), room_.lights);
    if (isCompact()) {
        pack::fillLights(plan, lights);
    } else {
        pack::fillMaskLights(plan, now_.draws, lights);
    }
    const std::span views(reinterpret_cast<shared::GpuView*>(bytes + room_.views_at), room_.views);
    pack::fillViews(plan, map_images_, views);
    placeTints(plan, maps, views);
}

void MaskPassRecorder::keep(std::uint32_t slot)
{
    assert(slot < slots_.size() && holds());
    if (isCompact() && slots_[slot].tiles_of != drawings_) {
        fillTiles(slots_[slot]);
    }
}

} // namespace gnomon::vulkan
