// SPDX-License-Identifier: Apache-2.0
// One texel of whole numbers, bound where a shader declares ids or blocks that a frame does not have. Nobody reads it:
// a constant of the pipeline says so.
#pragma once

#include "barriers.h"

namespace gnomon::vulkan {

class StandIn {
public:
    StandIn() = default;
    explicit StandIn(Device& device)
        : image_(device, {VK_FORMAT_R32_UINT, {1, 1}, 1, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT, "mask"})
    {
    }

    explicit operator bool() const { return static_cast<bool>(image_); }
    [[nodiscard]] VkImageView view() const { return image_.view(); } // an array of one layer
    [[nodiscard]] VkImageView layer() const { return image_.layer(0); }
    /// Before the first pass that binds it, in SHADER_READ_ONLY_OPTIMAL.
    void makeReadable(const Device& device, VkCommandBuffer commands)
    {
        if (readable_) {
            return;
        }
        ImageBarrier barrier;
        barrier.image = image_.image();
        barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        barrier.target_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        recordBarrier(device, commands, barrier);
        readable_ = true;
    }

private:
    Image image_;
    bool readable_ = false;
};

} // namespace gnomon::vulkan
