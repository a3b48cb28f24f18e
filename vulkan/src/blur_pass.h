// SPDX-License-Identifier: Apache-2.0
// The separable blur of a tile: along x into the scratch image, along y back. By compute or by fragment shaders.
#pragma once

#include "moment_images.h"

namespace gnomon::vulkan {

class BlurPass {
public:
    /// `path` is not automatic.
    BlurPass(FilterLayout& layout, const FilterConstants& constants, VkFormat format, BlurPath path);

    static constexpr std::uint32_t kSets = 2;
    void makeSets(const MomentImages& images);
    /// Level 0 of the tile and the blocks' flags are visible to COMPUTE_SHADER, before and after.
    void record(const FilterStep& step, const MomentImages& images) const;
    /// From what the GPU counted.
    [[nodiscard]] FilterCost cost(const shared::BlurCounts& counts) const;

private:
    struct Direction {
        Pipeline pipeline;
        VkDescriptorSet set = VK_NULL_HANDLE;
    };

    [[nodiscard]] Direction makeDirection(FilterConstants constants, int axis, VkFormat format);
    void recordBlocks(const FilterStep& step) const;
    void recordCompute(const FilterStep& step) const;
    void recordFragment(const FilterStep& step, const MomentImages& images) const;
    void draw(const FilterStep& step, const Direction& direction, const shared::FilterPassPlace& place,
              const Image& target, std::uint32_t layer) const;

    FilterLayout& layout_;
    BlurPath path_;
    std::uint32_t radius_;
    std::uint32_t texel_bytes_;
    bool logarithms_;
    Pipeline blocks_;
    Direction along_x_;
    Direction along_y_;
};

} // namespace gnomon::vulkan
