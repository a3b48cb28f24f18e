// SPDX-License-Identifier: Apache-2.0
// Edges of casters, made wide beside their maps (gnomon/shared/smoothies.h): an image beside that of the maps, made
// anew wherever a map was drawn. Three passes: edges are found, and made wide along x and along y.
#pragma once

#include "barriers.h"
#include "descriptors.h"
#include "map_step.h"

namespace gnomon::vulkan {

class SmoothieMaps final : public MapStep {
public:
    /// Precondition: options.hasSmoothies().
    SmoothieMaps(Device& device, const ResolvedOptions& options, VkPipelineCache cache);

    [[nodiscard]] const char* passName() const override { return "shadow filter"; }
    [[nodiscard]] bool needsDrawnMaps() const override { return true; } // its image is not copied
    void setMaps(const Image& maps) override;
    void record(const MapJob& job) override;
    [[nodiscard]] const Image& image() const override { return image_; }

private:
    struct Pass {
        DescriptorSets sets;
        PipelineLayout layout;
        Pipeline pipeline;
        VkDescriptorSet set = VK_NULL_HANDLE;
    };
    struct Push {
        std::int32_t tile[4];
        std::int32_t area[4];
        float rule[4];
    };

    [[nodiscard]] Pass makePass(std::span<const std::uint32_t> code, std::span<const VkDescriptorType> types,
                                VkPipelineCache cache) const;
    void bindImages(Pass& pass, std::span<const DescriptorSets::Write> images);
    void begin(VkCommandBuffer commands);
    void recordMap(VkCommandBuffer commands, const View& view, const VkRect2D& redrawn) const;
    void dispatch(VkCommandBuffer commands, const Pass& pass, const View& view, const VkRect2D& area) const;

    Device& device_;
    std::int32_t reach_;
    float quantum_;
    Pass edges_;
    Pass along_x_;
    Pass along_y_;
    Image image_;
    Image scratch_; // results of the first two passes for one map, a layer each
    bool has_layout_ = false;
};

} // namespace gnomon::vulkan
