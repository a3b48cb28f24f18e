// SPDX-License-Identifier: Apache-2.0
// Lloyd relaxation of one view's layers of depth on the GPU: a histogram of what was drawn, then steps of k-means.
#pragma once

#include "descriptors.h"

#include <layer_placing.h>

namespace gnomon::vulkan {

class LayerRelaxation {
public:
    LayerRelaxation(Device& device, const FilterOptions& filter, VkPipelineCache cache);

    /// Descriptors that name the depth image or the layers are out of date; nothing that uses them is pending.
    void forget();
    struct Job {
        VkImageView depth = VK_NULL_HANDLE;
        VkBuffer layers = VK_NULL_HANDLE;
        shared::GpuHistogramPush histogram;
        shared::GpuPlacePush place;
    };
    /// Afterwards the layers are visible to COMPUTE_SHADER, FRAGMENT_SHADER and host reads.
    void record(VkCommandBuffer commands, const Job& job);

private:
    void updateSet(const Job& job);

    Device& device_;
    DeviceBuffer histogram_;
    DescriptorSets sets_;
    PipelineLayout count_layout_;
    PipelineLayout place_layout_;
    Pipeline count_;
    Pipeline place_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkImageView depth_ = VK_NULL_HANDLE; // what the set holds now
    VkBuffer layers_ = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
