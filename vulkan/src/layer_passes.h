// SPDX-License-Identifier: Apache-2.0
// The two passes that place one view's layers of depth on the GPU: one sums up what was drawn, one places them by it.
// By Lloyd's rule a histogram and steps of k-means, by gaps a table of what would bleed and its least.
#pragma once

#include "descriptors.h"

#include <gnomon/shared/layer_placing.h>

namespace gnomon::vulkan {

class LayerPasses {
public:
    LayerPasses(Device& device, const ResolvedOptions& options, VkPipelineCache cache);

    /// Sets the images that every job reads from and writes to from now on. They are new, even where a handle was used
    /// before.
    void setImages(VkImageView depth, VkBuffer layers);
    struct Job {
        shared::GpuHistogramPush histogram;
        shared::GpuPlacePush place;
    };
    /// Afterwards the layers are visible to COMPUTE_SHADER, FRAGMENT_SHADER and host reads.
    void record(VkCommandBuffer commands, const Job& job);

private:
    Device& device_;
    VkDeviceSize sum_bytes_;
    DeviceBuffer sums_;
    DescriptorSets sets_;
    PipelineLayout count_layout_;
    PipelineLayout place_layout_;
    Pipeline count_;
    Pipeline place_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
