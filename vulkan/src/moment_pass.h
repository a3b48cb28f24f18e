// SPDX-License-Identifier: Apache-2.0
// From a tile of drawn depths to level 0 of a filterable map that is not blurred (else: blur_pass.h).
#pragma once

#include "moment_images.h"

namespace gnomon::vulkan {

class MomentPass {
public:
    MomentPass(FilterLayout& layout, const ResolvedOptions& options);

    static constexpr std::uint32_t kSets = 1;
    void makeSets(const MomentImages& images);
    /// The depths are visible to COMPUTE_SHADER.
    void record(const FilterStep& step) const;

private:
    FilterLayout& layout_;
    Pipeline pipeline_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
