// SPDX-License-Identifier: Apache-2.0
// Lloyd relaxation of one view's layers of depth on the GPU: a histogram of what was drawn, then steps of k-means.
#pragma once

#include "descriptors.h"

#include <layer_placing.h>

namespace gnomon::vulkan {

class LayerRelaxation {
public:
    LayerRelaxation(Device& device, const ResolvedOptions& options, VkPipelineCache cache);

    /// What every job reads from and writes to, from here on. They are new: a handle may be one that was used before.
    void setImages(VkImageView depth, VkBuffer layers);
    struct Job {
        shared::GpuHistogramPush histogram;
        shared::GpuPlacePush place;
    };
    /// Afterwards the layers are visible to COMPUTE_SHADER, FRAGMENT_SHADER and host reads.
    void record(VkCommandBuffer commands, const Job& job);

private:
    Device& device_;
    DeviceBuffer histogram_;
    DescriptorSets sets_;
    PipelineLayout count_layout_;
    PipelineLayout place_layout_;
    Pipeline count_;
    Pipeline place_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
