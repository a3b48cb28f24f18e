// SPDX-License-Identifier: Apache-2.0
// Where lvsm's layers of depth lie, for every view, in one buffer that the passes read.
#pragma once

#include "layer_passes.h"

#include <gnomon/pack/filter_passes.h>

#include <gnomon/shared/gpu_structs.h>

#include <optional>

namespace gnomon::vulkan {

class LayerPlacer {
public:
    /// For other filters than lvsm the buffer has one entry that nothing reads, so that descriptors have something.
    LayerPlacer(Device& device, const ResolvedOptions& options, VkPipelineCache cache);

    /// A map's layers have the slot of its MapId::index, whether or not a view of this plan draws or reads it: what was
    /// drawn with them may be read later. True when the buffer was made anew, larger.
    bool prepare(const Plan& plan);
    /// The image that depths are drawn into, or the buffer, is another one. `depth`: of one layer.
    void setDepth(VkImageView depth);
    /// To be called before anything else is recorded after prepare(): what the layers of a buffer that has grown were
    /// is copied.
    void copyOutgrown(VkCommandBuffer commands);
    /// pack::depthLayersSlot() for lvsm, 0 for others.
    [[nodiscard]] std::uint32_t slotOf(const Plan& plan, std::uint32_t view) const;
    /// Places the layers of a view whose depths have just been drawn (its own tile's rectangle, `samples` each,
    /// SHADER_READ_ONLY_OPTIMAL, visible to COMPUTE_SHADER reads). Afterwards the buffer is visible to
    /// COMPUTE_SHADER, FRAGMENT_SHADER and host reads.
    void record(VkCommandBuffer commands, const Plan& plan, std::uint32_t view);
    [[nodiscard]] VkBuffer buffer() const; // std430: GpuDepthLayers by slot
    [[nodiscard]] VkDeviceSize bytes() const;
    /// The layers of a slot, once the GPU has finished. Empty for other filters.
    [[nodiscard]] std::vector<pack::DepthLayer> read(std::uint32_t slot) const;

private:
    void makeBuffer(std::uint32_t slots);
    [[nodiscard]] shared::GpuDepthLayers* entries() const;
    void write(VkCommandBuffer commands, const View& view, std::uint32_t slot);

    Device& device_;
    ResolvedOptions options_;
    pack::LayerSteps steps_;
    std::optional<LayerPasses> passes_; // lvsm with layers that follow what is drawn
    HostBuffer buffer_;
    HostBuffer outgrown_; // holds the placed layers until they have been copied
    bool copied_ = false; // it has been, and is retired by the next prepare(): recording allocates nothing
    std::uint32_t slots_ = 0;
};

} // namespace gnomon::vulkan
