// SPDX-License-Identifier: Apache-2.0
// Fits views with ViewProjection::gpu_cascade to the camera's depth buffer, on the GPU: what is found is read by the
// passes that draw the maps and is put into the mask's constants, and never waits for the CPU.
#pragma once

#include "descriptors.h"
#include "stand_in.h"

#include <gnomon/shared/gpu_cascades.h>

#include <array>

namespace gnomon::vulkan {

class CascadeFitter {
public:
    CascadeFitter(Device& device, std::uint32_t slots, VkPipelineCache cache);

    /// Makes what such a plan needs; nothing for a plan without such views.
    void prepare(const Plan& plan);
    /// Makes the pipelines, if they are not there.
    void warmUp();
    /// Afterwards views() is visible to vertex shaders, as attribute and as storage buffer, and to COMPUTE_SHADER.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs);
    /// Has the plan views for it?
    [[nodiscard]] static bool fits(const Plan& plan);
    /// Has record() been given this plan, or does it need none?
    [[nodiscard]] bool isFitted(const Plan& plan) const;
    [[nodiscard]] VkBuffer views() const { return views_.buffer(); } // GpuFittedView by view of the plan
    /// Whose views are completed: each has a descriptor set of its own for every slot.
    enum class Reader : std::uint8_t { mask, host };
    struct Views {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize offset = 0; // bytes
        std::uint32_t count = 0;
    };
    /// Completes views in a storage buffer: those that say in slice.w for which view of the plan, counted from 1.
    /// Afterwards they are visible to FRAGMENT_SHADER and COMPUTE_SHADER as storage buffer.
    void recordViews(VkCommandBuffer commands, std::uint32_t slot, Reader reader, const Views& views);
    /// The fit of every view of the last plan that was recorded with this slot, once the GPU has finished. Empty
    /// without such views.
    [[nodiscard]] std::vector<FittedView> read(std::uint32_t slot) const;

private:
    struct Slot {
        HostBuffer lights;
        HostBuffer report;
        std::uint32_t view_count = 0; // in the report
        VkDescriptorSet fit = VK_NULL_HANDLE;
        std::array<VkDescriptorSet, 2> complete{}; // by Reader
    };
    enum Pass : std::uint32_t { kDepthPass, kDepthIdsPass, kBoundsPass, kBoundsIdsPass, kFinishPass, kPassCount };

    void makePipelines();
    void makeSets();
    void makeBuffers(std::uint32_t views, std::uint32_t lights);
    void writeFitSet(Slot& slot, const MaskInputs& inputs);
    void dispatch(VkCommandBuffer commands, Pass pass, const glm::uvec3& groups) const;

    Device& device_;
    std::uint32_t slot_count_;
    VkPipelineCache cache_;
    DescriptorSets fit_sets_;
    DescriptorSets complete_sets_;
    PipelineLayout fit_layout_;
    PipelineLayout complete_layout_;
    std::array<Pipeline, kPassCount> passes_;
    Pipeline complete_;
    StandIn no_ids_;
    DeviceBuffer keys_;
    DeviceBuffer views_;
    std::vector<Slot> slots_;
    std::uint64_t fitted_frame_ = ~std::uint64_t{0};
};

} // namespace gnomon::vulkan
