// SPDX-License-Identifier: Apache-2.0
// The parts of a ShadowRenderer, how they are fitted to a plan, and checks that a call fits them.
#pragma once

#include "cascade_fitter.h"
#include "map_class.h"
#include "mask_pass.h"
#include "seen_cells.h"
#include "usage.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <memory>
#include <vector>

namespace gnomon::vulkan {

/// Made by warmUp(), without images.
struct Spare {
    ResolvedOptions options; // that it was made for; it may serve others, too
    std::unique_ptr<MapClass> maps;
};

/// All that a renderer makes. One that a call left half way, because something threw, is given up as a whole.
struct RendererParts {
    RendererParts(Device& device_in, const ShadowRendererOptions& options_in, bool layered_in)
        : device(device_in), options(options_in), fitter(device, options.frames_in_flight, options.pipeline_cache),
          mask(device, options), seen(device, options.frames_in_flight, options.pipeline_cache), layered(layered_in),
          reuse(options.frames_in_flight), mask_kept(options.frames_in_flight)
    {
    }

    [[nodiscard]] std::unique_ptr<MapClass> makeClass(const ResolvedOptions& wanted);
    /// ShadowRenderer::prepare().
    [[nodiscard]] bool prepare(const Plan& plan, VkExtent2D screen);
    /// The maps of one of the last plan's options; null where no light has named them.
    [[nodiscard]] const MapClass* classOf(std::uint32_t index) const
    {
        return index < classes.size() ? classes[index].get() : nullptr;
    }

    /// Each throws Error, before anything is recorded.
    void checkUse(const char* tried, VkCommandBuffer commands, std::uint32_t slot, const Plan& plan) const;
    void checkPrepared(const char* tried, const Plan& plan) const;
    static void checkInputs(const char* tried, const MaskInputs& inputs);
    void checkFitted(const char* tried, const Plan& plan) const;

    Device& device;
    const ShadowRendererOptions& options;
    MapClasses classes; // by options of the last plan; null where no light has named them
    std::vector<Spare> spares;
    CascadeFitter fitter;
    MaskPassRecorder mask;
    SeenCells seen;
    bool layered;                        // the device can
    std::vector<pack::FramePass> passes; // passes of the plan that was prepared last
    std::vector<MapReuse> reuse;         // by slot
    std::vector<std::uint8_t> mask_kept; // by slot
    pack::MapNotes notes;
    PreparedSize prepared;
    bool has_mask = false; // prepare() was given a screen

private:
    [[nodiscard]] std::unique_ptr<MapClass> takeClass(const ResolvedOptions& wanted);
    void matchClasses(const Plan& plan);
    void check(const ResolvedOptions& wanted) const;
};

} // namespace gnomon::vulkan
