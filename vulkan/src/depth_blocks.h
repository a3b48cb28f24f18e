// SPDX-License-Identifier: Apache-2.0
// The nearest and the farthest depth of squares of a map's texels (gnomon/shared/map_blocks.h), for filters that look
// far around a receiver. An image beside that of the maps, made anew wherever a map was drawn.
#pragma once

#include "barriers.h"
#include "descriptors.h"

namespace gnomon::vulkan {

class DepthBlocks {
public:
    DepthBlocks(Device& device, VkPipelineCache cache);

    /// For these maps, an image that has just been made. All blocks are to be made by recordAll() then.
    void setMaps(const Image& maps);
    [[nodiscard]] bool isNew() const { return is_new_; }

    // While commands are recorded, the maps being readable by shaders:

    /// Records the blocks of all layers and texels.
    void recordAll(VkCommandBuffer commands);
    /// To be called before and after any number of record().
    void begin(VkCommandBuffer commands);
    void end(VkCommandBuffer commands);
    /// Records the blocks of one layer that texels of `area` lie in.
    void record(VkCommandBuffer commands, const VkRect2D& area, std::uint32_t layer);

    /// Level L of the blocks is mip level L - 1. In GENERAL once recorded.
    [[nodiscard]] const Image& image() const { return image_; }

private:
    struct Kind {
        Pipeline pipeline;
        DescriptorSets sets;
        PipelineLayout layout;
    };
    struct Push {
        std::int32_t first[4];
        std::int32_t last[4];
    };
    // Makes kBlockLevelsOfPass levels, or those that are left.
    struct Pass {
        const Kind* kind = nullptr;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::uint32_t first_level = 0; // mip level
        std::uint32_t levels = 0;
    };

    [[nodiscard]] Kind makeKind(VkDescriptorType source, std::span<const std::uint32_t> code, VkPipelineCache cache);
    void addPass(Kind& kind, std::uint32_t first_level, const DescriptorSets::Write& source);
    void dispatch(VkCommandBuffer commands, const Pass& pass, const VkRect2D& area, std::uint32_t layer);

    Device& device_;
    Image image_;
    VkExtent2D maps_{};
    std::uint32_t layers_ = 0;
    bool is_new_ = false;
    bool has_layout_ = false;
    Kind from_maps_;
    Kind from_blocks_;
    std::vector<Pass> passes_;
};

} // namespace gnomon::vulkan
