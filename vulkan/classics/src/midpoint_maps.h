// SPDX-License-Identifier: Apache-2.0
// Maps that hold the midpoint of the casters' first two surfaces. The surfaces are drawn one after the other, each into
// an image of depths, the second one by leaving out what is not behind the first; then what lies midway is drawn to the
// map. Based on: A. Woo, "The Shadow Depth Map Revisited", Graphics Gems III, 1992; the second surface by peeling: C.
// Everitt, "Interactive Order-Independent Transparency", 2001.
#pragma once

#include "descriptors.h"
#include "map_step.h"
#include "map_storage.h"

#include <array>

namespace gnomon::vulkan {

class MidpointMaps final : public ViewPainter {
public:
    /// Precondition: the storage is depth alone.
    MidpointMaps(Device& device, const MapStorage& storage, VkPipelineCache cache);

    void cover(VkExtent2D page) override;
    /// Draws both surfaces, which the callback sees as two passes.
    void drawCasters(const MapJob& job, std::uint32_t view) override;
    void drawMap(VkCommandBuffer commands) const override;

private:
    void makeReadable(VkCommandBuffer commands, const Image& surface) const;
    void beginSurface(VkCommandBuffer commands, const Image& surface, const Tile& tile) const;

    Device& device_;
    const MapStorage& storage_;
    Sampler sampler_;
    DescriptorSets first_sets_; // ClassicPass::first_surface
    DescriptorSets both_sets_;
    PipelineLayout layout_;
    Pipeline pipeline_;
    std::array<Image, 2> surfaces_;
    VkDescriptorSet first_ = VK_NULL_HANDLE;
    VkDescriptorSet both_ = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
