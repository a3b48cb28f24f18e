// SPDX-License-Identifier: Apache-2.0
// A tile of drawn depths becomes a filterable map and is blurred in two passes: along x from the depths into the
// scratch image, along y from there into the map. The first is a compute shader's, the second a compute or fragment
// shader's.
#pragma once

#include "moment_images.h"

namespace gnomon::vulkan {

class BlurPass {
public:
    BlurPass(FilterLayout& layout, const ResolvedOptions& options, VkFormat format);

    static constexpr std::uint32_t kSets = 2;
    void makeSets(const MomentImages& images);
    /// The depths are visible to COMPUTE_SHADER, and level 0 of the tile is then.
    void record(const FilterStep& step, const MomentImages& images) const;
    /// From what the GPU counted.
    [[nodiscard]] FilterCost cost(const shared::BlurCounts& counts) const;

private:
    void recordBlocks(const FilterStep& step) const;
    void recordCompute(const FilterStep& step) const;
    void recordFragment(const FilterStep& step, const MomentImages& images) const;

    FilterLayout& layout_;
    MomentOptions moments_;
    BlurPath path_;
    std::uint64_t radius_;
    std::uint64_t texel_bytes_;
    std::uint64_t image_layers_;
    bool logarithms_;
    Pipeline along_x_;
    Pipeline blocks_;
    Pipeline along_y_;
    VkDescriptorSet set_x_ = VK_NULL_HANDLE;
    VkDescriptorSet set_y_ = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
