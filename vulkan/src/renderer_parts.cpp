// SPDX-License-Identifier: Apache-2.0
#include "renderer_parts.h"

#include <gnomon/error.h>

#include <algorithm>
#include <utility>

namespace gnomon::vulkan {

void RendererParts::check(const ResolvedOptions& wanted) const
{
    if (wanted.cascades().pass == CascadePass::layered && !layered) {
        throw Error("draw cascades in one pass", "the device was made without shaderOutputLayer",
                    "draw each in a pass of its own");
    }
}

void RendererParts::checkUse(const char* tried, VkCommandBuffer commands, std::uint32_t slot, const Plan& plan) const
{
    checkCommands(tried, commands);
    checkSlot(tried, slot, options.frames_in_flight);
    checkPrepared(tried, plan);
}

void RendererParts::checkPrepared(const char* tried, const Plan& plan) const
{
    pack::checkPlan(tried, plan);
    bool fits = prepared.holds(plan);
    for (const LightPlan& light : plan.lights) {
        const std::uint32_t i = light.options;
        const bool needs_maps = (*plan.options)[i].hasMaps();
        fits = fits && (!needs_maps || (i < classes.size() && classes[i] && classes[i]->serves((*plan.options)[i])));
        fits = fits && (light.volume_count == 0 || !has_mask || mask.countsVolumes());
    }
    if (!fits) {
        refuseUse(tried, "the plan needs other images than those that are there", "call prepare() with it first");
    }
}

void RendererParts::checkInputs(const char* tried, const MaskInputs& inputs)
{
    if (inputs.depth == VK_NULL_HANDLE) {
        refuseUse(tried, "MaskInputs::depth is null", "hand in the camera's depth");
    }
    if (inputs.extent.width == 0 || inputs.extent.height == 0) {
        refuseUse(tried, "MaskInputs::extent is 0", "say how large the camera's depth is");
    }
}

void RendererParts::checkFitted(const char* tried, const Plan& plan) const
{
    if (!fitter.isFitted(plan)) {
        refuseUse(tried, "the plan's cascades are fitted on the GPU, and were not yet",
                  "call recordBounds() with it first");
    }
}

std::unique_ptr<MapClass> RendererParts::makeClass(const ResolvedOptions& wanted)
{
    check(wanted);
    return std::make_unique<MapClass>(device, wanted, options.frames_in_flight, options.pipeline_cache,
                                      options.classics.get());
}

std::unique_ptr<MapClass> RendererParts::takeClass(const ResolvedOptions& wanted)
{
    check(wanted);
    const auto found = std::ranges::find_if(spares, [&](const Spare& spare) { return spare.maps->serves(wanted); });
    if (found == spares.end()) {
        return makeClass(wanted);
    }
    std::unique_ptr<MapClass> taken = std::move(found->maps);
    spares.erase(found);
    return taken;
}

/// Options that are others than those of the last plan lose their maps, unless these are made in the same way.
void RendererParts::matchClasses(const Plan& plan)
{
    for (std::uint32_t i = 0; i < classes.size(); ++i) {
        const bool goes_on = i < plan.options->size() && classes[i] && classes[i]->serves((*plan.options)[i]);
        if (classes[i] && !goes_on) {
            device.retire(std::move(classes[i]));
            notes.lose(i);
        }
    }
    classes.resize(std::max(classes.size(), plan.options->size()));
    for (const pack::FramePass& pass : passes) {
        if (pass.kind == pack::FramePassKind::maps && !classes[pass.options]) {
            classes[pass.options] = takeClass((*plan.options)[pass.options]);
        }
    }
}

bool RendererParts::prepare(const Plan& plan, VkExtent2D screen)
{
    prepared.forget(); // until all of it is there
    has_mask = false;
    pack::listFramePasses(plan, passes);
    matchClasses(plan);
    notes.reserve(plan);
    bool changed = false;
    for (const pack::FramePass& pass : passes) {
        if (pass.kind == pack::FramePassKind::maps) {
            check((*plan.options)[pass.options]);
            const MapRecorder::Prepared maps = classes[pass.options]->recorder->prepare(plan, pass.options);
            const bool tints_changed = classes[pass.options]->tints.prepare(plan, pass.options, options.is_blended);
            changed = changed || maps.changed || tints_changed;
            if (maps.lost) {
                notes.lose(pass.options);
            }
        }
    }
    if (changed) {
        notes.change();
    }
    fitter.prepare(plan);
    const bool wants_mask = screen.width > 0 && screen.height > 0;
    const bool mask_changed = wants_mask && mask.prepare(plan, screen, classes);
    has_mask = wants_mask;
    seen.prepare(plan, options.compact.channels == 0 ? screen : VkExtent2D{});
    prepared.take(plan);
    return changed || mask_changed;
}

} // namespace gnomon::vulkan
