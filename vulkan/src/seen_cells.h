// SPDX-License-Identifier: Apache-2.0
// For partition virtual: what the mask shows of each light, cell by cell, for the planning of frames to come. The GPU
// writes it, and the host reads it when the frame's slot comes round again. Nobody waits.
#pragma once

#include "descriptors.h"

#include <vector>

namespace gnomon::vulkan {

class SeenCells {
public:
    SeenCells(Device& device, std::uint32_t slots, VkPipelineCache cache)
        : device_(device), cache_(cache), slots_(slots)
    {
    }

    /// Makes the pipeline.
    void warmUp();
    /// Makes what such a plan needs; nothing for a plan without lights of partition virtual.
    void prepare(const Plan& plan, VkExtent2D screen);
    /// After the mask, which is readable. Afterwards the host may read once the GPU has finished. `kept`: the mask is
    /// that of the last record(); then a slot that shows it already is left as it is.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                const Image& mask, bool kept);
    /// By light, of the last record() with this slot. They hold until the next one, or prepare().
    [[nodiscard]] std::span<const PageRequests> read(std::uint32_t slot) const;

private:
    struct Slot {
        HostBuffer cells;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::vector<PageRequests> requests;
        std::uint64_t mask = 0; // which it shows: masks_
    };
    void bind(VkCommandBuffer commands, const Slot& slot, const MaskInputs& inputs, const Image& mask);

    Device& device_;
    VkPipelineCache cache_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    Pipeline pipeline_;
    Sampler nearest_;
    std::vector<Slot> slots_;
    VkDeviceSize bytes_ = 0;  // of each slot's cells
    std::uint64_t masks_ = 0; // number of masks that were drawn
};

} // namespace gnomon::vulkan
