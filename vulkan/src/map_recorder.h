// SPDX-License-Identifier: Apache-2.0
// The renderer's interface to the passes that draw maps. There are two kinds: DepthMaps (map_pass.h) only draws them;
// MomentMaps (moment_maps.h) draws depth and makes a filterable map of it.
#pragma once

#include "device.h"

#include <gnomon/pack/map_notes.h>
#include <gnomon/plan_views.h>

namespace gnomon::vulkan {

/// The inputs of one recording.
struct MapJob {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint32_t slot = 0;
    const Plan& plan;
    std::uint32_t options = 0;            // index into Plan::options: views of others are left alone
    std::span<const pack::ViewWork> work; // by view
    const DrawCasters& draw;
    const ClassicPass* classic = nullptr; // MapPass::classic of what these options ask for; null: nothing
    VkBuffer placements = VK_NULL_HANDLE; // GpuFittedView by view of the plan
    Profiler* profiler = nullptr;

    [[nodiscard]] pack::ViewWork of(std::uint32_t view) const
    {
        return optionsIndexOf(plan, plan.views[view]) == options ? work[view] : pack::ViewWork{};
    }
    /// The profiler where there is a map to draw: a pass that draws none is not listed.
    [[nodiscard]] Profiler* profilerOfWork() const
    {
        for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
            if (of(i).draw) {
                return profiler;
            }
        }
        return nullptr;
    }
};

class MapRecorder {
public:
    MapRecorder() = default;
    virtual ~MapRecorder() = default;
    MapRecorder(const MapRecorder&) = delete;
    MapRecorder& operator=(const MapRecorder&) = delete;

    /// Makes the pipelines that prepare() makes when a plan first needs them.
    virtual void warmUp(const ResolvedOptions&) {}
    struct Prepared {
        bool changed = false; // there are new images or buffers
        bool lost = false;    // and what maps held could not be taken over
    };
    /// Makes larger images and buffers if the plan does not fit. Their contents are copied at the next record().
    /// `options`: index into Plan::options.
    virtual Prepared prepare(const Plan& plan, std::uint32_t options) = 0;
    /// Does the work in `job.work` for each view of the plan.
    virtual void record(const MapJob& job) = 0;
    /// Brings layers that were never drawn into the layout that the mask pass reads them in.
    virtual void makeReadable(VkCommandBuffer commands) = 0;
    [[nodiscard]] virtual const Image& maps() const = 0;
    /// The maps' second image, in GENERAL: MapStep::image(); null for filters that need none.
    [[nodiscard]] virtual const Image* blocks() const { return nullptr; }
    [[nodiscard]] virtual FilterCost cost(std::uint32_t slot) const = 0;
};

} // namespace gnomon::vulkan
