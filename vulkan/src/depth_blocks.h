// SPDX-License-Identifier: Apache-2.0
// The nearest and the farthest depth of squares of a map's texels (gnomon/shared/map_blocks.h), for filters that look
// far around a receiver. An image beside that of the maps, made anew wherever a map was drawn.
#pragma once

#include "barriers.h"
#include "descriptors.h"
#include "map_step.h"
#include "samplers.h"

#include <gnomon/pack/filter_passes.h>

#include <array>

namespace gnomon::vulkan {

class DepthBlocks final : public MapStep {
public:
    DepthBlocks(Device& device, VkPipelineCache cache);

    /// The next record() makes all blocks.
    void setMaps(const Image& maps) override;
    void record(const MapJob& job) override;
    /// Level L of the blocks is mip level L - 1.
    [[nodiscard]] const Image& image() const override { return image_; }

private:
    struct Kind {
        Pipeline pipeline;
        DescriptorSets sets;
        PipelineLayout layout;
    };
    struct Push {
        std::array<std::int32_t, 4> first;
        std::array<std::int32_t, 4> last;
    };
    // Makes kBlockLevelsOfPass levels, or those that are left.
    struct Pass {
        const Kind* kind = nullptr;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::uint32_t first_level = 0; // mip level
    };

    [[nodiscard]] Kind makeKind(VkDescriptorType source, std::span<const std::uint32_t> code, VkPipelineCache cache);
    void recordAll(VkCommandBuffer commands);
    /// Before and after any number of recordArea().
    void begin(VkCommandBuffer commands);
    void end(VkCommandBuffer commands);
    /// The blocks of one layer that texels of `area` lie in.
    void recordArea(VkCommandBuffer commands, const VkRect2D& area, std::uint32_t layer);
    void addPass(Kind& kind, std::uint32_t first_level, const DescriptorSets::Write& source);
    void dispatch(VkCommandBuffer commands, const Pass& pass, const pack::BlockPass& work);

    Device& device_;
    Image image_;
    VkExtent2D maps_{};
    std::uint32_t layers_ = 0;
    bool is_new_ = false; // no block is made yet
    bool has_layout_ = false;
    Sampler nearest_;
    Kind from_maps_;
    Kind from_blocks_;
    std::vector<Pass> passes_;
};

} // namespace gnomon::vulkan
