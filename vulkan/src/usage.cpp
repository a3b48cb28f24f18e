// SPDX-License-Identifier: Apache-2.0
#include "usage.h"

#include <gnomon/error.h>
#include <gnomon/pack/cascade_lights.h>
#include <gnomon/pack/depth_layers.h>
#include <gnomon/pack/shading_buffers.h>
#include <gnomon/plan_views.h>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

void refuseUse(const char* tried, const char* found, const char* instead)
{
    throw Error(tried, found, instead);
}

std::uint32_t checkedFrames(std::uint32_t frames_in_flight)
{
    if (frames_in_flight == 0 || frames_in_flight > kMostFrames) {
        throw Error("keep " + std::to_string(frames_in_flight) + " frames in flight",
                    "there can be 1 to " + std::to_string(kMostFrames));
    }
    return frames_in_flight;
}

void checkSlot(const char* tried, std::uint32_t slot, std::uint32_t frames_in_flight)
{
    if (slot >= frames_in_flight) {
        throw Error(std::string(tried) + " with slot " + std::to_string(slot),
                    "there are " + std::to_string(frames_in_flight) + " frames in flight",
                    "count slots from 0, and make it with as many as there are");
    }
}

void checkCommands(const char* tried, VkCommandBuffer commands)
{
    if (commands == VK_NULL_HANDLE) {
        refuseUse(tried, "the command buffer is null", "hand in one that is being recorded");
    }
}

bool hasPieces(const Plan& plan)
{
    return std::ranges::any_of(plan.lights, [&](const LightPlan& light) {
        return light.first_object_id != kNoIndex && (*plan.options)[light.options].ids().of == IdOf::face;
    });
}

std::vector<PreparedSize::OfOptions>& PreparedSize::measure(const Plan& plan, std::vector<OfOptions>& out)
{
    out.assign(plan.options->size(), {});
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].pages = plan.pages[i];
    }
    for (const LightPlan& light : plan.lights) {
        out[light.options].wanted = true;
    }
    for (const View& view : plan.views) {
        std::uint32_t& side = out[plan.lights[view.light].options].tile_side;
        side = std::max({side, view.place.tile.width, view.place.tile.height});
    }
    return out;
}

void PreparedSize::take(const Plan& plan)
{
    (void)measure(plan, options_);
    asked_.reserve(options_.size());
    lights_ = plan.lights.size();
    views_ = std::max(views_, plan.views.size()); // buffers for views do not shrink
    depth_layers_ = std::max(depth_layers_, pack::depthLayersCount(plan));
    cascade_lights_ = std::max(cascade_lights_, pack::cascadeLightCount(plan));
    object_vectors_ = std::max(object_vectors_, pack::objectVectorCount(plan));
    mask_layers_ = plan.mask_layers;
    mask_channels_ = maskChannelCount(plan);
}

bool PreparedSize::holds(const Plan& plan) const
{
    if (plan.lights.size() > lights_ || plan.views.size() > views_ || pack::cascadeLightCount(plan) > cascade_lights_ ||
        pack::objectVectorCount(plan) > object_vectors_) {
        return false;
    }
    if (plan.mask_layers > mask_layers_ || maskChannelCount(plan) > mask_channels_) {
        return false;
    }
    for (std::uint32_t view = 0; view < plan.views.size(); ++view) {
        if (pack::depthLayersSlot(plan, view) >= depth_layers_ &&
            optionsOf(plan, plan.views[view]).filter() == Filter::lvsm) {
            return false;
        }
    }
    (void)measure(plan, asked_);
    for (std::size_t i = 0; i < asked_.size(); ++i) {
        const OfOptions& asked = asked_[i];
        if (!asked.wanted) {
            continue;
        }
        if (i >= options_.size() || !options_[i].wanted) {
            return false;
        }
        const OfOptions& have = options_[i];
        if (asked.pages.width > have.pages.width || asked.pages.height > have.pages.height ||
            asked.pages.layers > have.pages.layers || asked.pages.kept_layers > have.pages.kept_layers ||
            asked.tile_side > have.tile_side) {
            return false;
        }
    }
    return true;
}

} // namespace gnomon::vulkan
