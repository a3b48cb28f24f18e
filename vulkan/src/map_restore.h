// SPDX-License-Identifier: Apache-2.0
// Draws what a map is before any caster is drawn into it: the kept map of what stands still, or nothing in one half of
// texels whose other half is another map's. A draw and not a copy, because a copy has no colour write mask.
#pragma once

#include "descriptors.h"
#include "map_storage.h"

#include <array>

namespace gnomon::vulkan {

class MapRestorer {
public:
    MapRestorer(Device& device, const MapStorage& storage, VkPipelineCache cache);

    /// The source that the depths of a kept map are restored from.
    enum class Source : std::uint8_t {
        depths,  // they were kept
        colours, // its colours, which hold two maps a texel: depths as they are stored
    };
    /// Views of all layers of images that are new, in SHADER_READ_ONLY_OPTIMAL when they are read. `colours` is null
    /// for depth-only maps, `depths` where all are restored from colours.
    void setKept(VkImageView depths, VkImageView colours);
    /// Makes the pipelines for maps that have this part of their texels.
    void ensure(TexelPart part, Source source);
    /// Restores depths and colours within the scissor; the pipeline must be ensured. Rendering has begun, viewport and
    /// scissor are set.
    void restore(VkCommandBuffer commands, TexelPart part, Source source, std::uint32_t layer);
    /// Sets the map's part of the colours to 1 within the scissor, in the same state. Depths have been cleared.
    void clear(VkCommandBuffer commands, TexelPart part);

private:
    [[nodiscard]] std::span<const std::uint32_t> codeFor(Source source) const;
    [[nodiscard]] Pipeline makePipeline(std::span<const std::uint32_t> fragment, TexelPart part);

    Device& device_;
    const MapStorage& storage_;
    VkPipelineCache cache_;
    Sampler sampler_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::array<std::array<Pipeline, 2>, 3> restores_; // by TexelPart and Source, made by ensure()
    std::array<Pipeline, 3> clears_;
};

} // namespace gnomon::vulkan
