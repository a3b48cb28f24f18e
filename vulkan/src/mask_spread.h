// SPDX-License-Identifier: Apache-2.0
// mask-size=half: the image of half the mask's size, and how it is spread over the mask. Where it says nothing the mask
// pass draws itself: MaskMarks have 0 where the mask is done, and a draw at depth 0 passes where it is not.
#pragma once

#include "descriptors.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <vector>

namespace gnomon::vulkan {

/// The inputs of the pass besides its own image.
struct SpreadInputs {
    VkImageView depth = VK_NULL_HANDLE;
    VkImageLayout depth_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageView normal = VK_NULL_HANDLE;     // VK_NULL_HANDLE: none
    VkImageView object_id = VK_NULL_HANDLE;  // VK_NULL_HANDLE: none
    VkImageView no_numbers = VK_NULL_HANDLE; // stands in for object_id
    VkBuffer constants = VK_NULL_HANDLE;     // begins with a GpuConstants
};

class MaskSpread {
public:
    MaskSpread(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    /// Makes the pipeline for masks of this format.
    void warmUp(VkFormat format, const MaskShape& inputs) { (void)pipeline({format, inputs.normals, inputs.ids}); }
    /// Makes the image for a mask like this one, if the one that is there does not fit.
    void prepare(const ImageInfo& mask);
    /// Is it there?
    [[nodiscard]] bool holds(const ImageInfo& mask) const;
    /// The image of half the size, rounded up, with the mask's layers. The pass that draws to it clears it to 1.
    [[nodiscard]] const Image& half() const { return half_; }

    /// Before the layers of a frame: half() may be read.
    void begin(std::uint32_t slot, const SpreadInputs& inputs);
    /// Spreads half() over `area` of a layer of the target, whose rendering MaskMarks::begin() has begun. Draws of what
    /// is left may follow, and then vkCmdEndRendering.
    void spread(VkCommandBuffer commands, const Image& target, std::uint32_t layer, const VkRect2D& area);

private:
    struct Key {
        VkFormat format = VK_FORMAT_UNDEFINED; // format of the target
        bool normals = true;
        bool ids = false;

        bool operator==(const Key&) const = default;
    };
    struct Made {
        Key key;
        Pipeline pipeline;
    };

    [[nodiscard]] VkPipeline pipeline(const Key& key);

    Device& device_;
    VkPipelineCache cache_;
    Sampler nearest_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    std::vector<VkDescriptorSet> slots_;
    std::vector<Made> pipelines_;
    Image half_;
    VkDescriptorSet set_ = VK_NULL_HANDLE; // for the frame that is being recorded
    bool normals_ = false;                 // the frame that is being recorded has normals
    bool ids_ = false;                     // the frame that is being recorded has object ids
};

} // namespace gnomon::vulkan
