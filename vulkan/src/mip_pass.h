// SPDX-License-Identifier: Apache-2.0
// The mip levels of a tile of a filterable map, each from the one before.
#pragma once

#include "moment_images.h"

namespace gnomon::vulkan {

class MipPass {
public:
    MipPass(FilterLayout& layout, const pack::FilterConstants& constants);

    [[nodiscard]] static std::uint32_t sets(std::uint32_t levels) { return levels - 1; }
    void makeSets(const MomentImages& images);
    /// Level 0 is visible to COMPUTE_SHADER; the coarsest is not waited for.
    void record(const FilterStep& step) const;

private:
    FilterLayout& layout_;
    Pipeline pipeline_;
    std::vector<VkDescriptorSet> sets_; // [i]: from level i to i + 1
};

} // namespace gnomon::vulkan
