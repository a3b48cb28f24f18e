// SPDX-License-Identifier: Apache-2.0
// Where lvsm's layers of depth lie, for every view, in one buffer that the passes read.
#pragma once

#include "layer_relaxation.h"

#include <gpu_structs.h>

#include <optional>

namespace gnomon::vulkan {

class LayerPlacer {
public:
    /// For other filters than lvsm the buffer has one entry that nothing reads, so that descriptors have something.
    LayerPlacer(Device& device, const FilterOptions& filter, VkPipelineCache cache);

    /// Gives every view of the plan a slot; a tile keeps its slot from plan to plan, because what was drawn with its
    /// layers may be kept. True when the buffer was made anew (then all maps are drawn again).
    bool prepare(const Plan& plan);
    /// The image that depths are drawn into was made anew: descriptors that name it are out of date, and nothing that
    /// uses them is pending.
    void forgetDepth();
    /// Of a view of the plan that was prepared last.
    [[nodiscard]] std::uint32_t slotOf(std::uint32_t view) const;
    /// Places the layers of a view whose depths have just been drawn into `depth` (its own tile's rectangle, layer 0,
    /// `samples` each, SHADER_READ_ONLY_OPTIMAL, visible to COMPUTE_SHADER reads). Afterwards the buffer is visible to
    /// COMPUTE_SHADER, FRAGMENT_SHADER and host reads.
    void record(VkCommandBuffer commands, const Plan& plan, std::uint32_t view, VkImageView depth);
    [[nodiscard]] VkBuffer buffer() const; // std430: GpuDepthLayers by slot
    [[nodiscard]] VkDeviceSize bytes() const;
    /// Once the GPU has finished.
    [[nodiscard]] std::vector<DepthLayer> read(std::uint32_t view) const;

private:
    struct Slot {
        bool taken = false;
        Tile tile;
        // What its layers were placed for; nothing placed yet without a metric.
        std::uint32_t light = kNoIndex;
        std::optional<DepthMetric> metric;
    };

    /// The slot of this tile, or else a free one, or kNoIndex.
    [[nodiscard]] std::uint32_t findSlot(const Tile& tile) const;
    void makeBuffer(std::uint32_t slots);
    [[nodiscard]] shared::GpuDepthLayers* entries() const;
    [[nodiscard]] shared::GpuHistogramPush histogramPush(const View& view) const;
    [[nodiscard]] shared::GpuPlacePush placePush(const View& view, std::uint32_t slot, bool held) const;

    Device& device_;
    FilterOptions filter_;
    std::optional<LayerRelaxation> relaxation_; // lvsm with layers placed by Lloyd's rule
    HostBuffer buffer_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> slot_of_view_;
};

} // namespace gnomon::vulkan
