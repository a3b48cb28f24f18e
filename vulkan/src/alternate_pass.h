// SPDX-License-Identifier: Apache-2.0
// Maps of a stepping sun by turns: the visibility by this frame's maps of one position is joined with the last frame's
// for the other position, moved to where its surfaces are now. This frame counts alone where the last frame did not see
// the surface, in the first frame, and where the last frame had another pair of positions.
#pragma once

#include "descriptors.h"
#include "mask_history.h"

#include <array>

namespace gnomon::vulkan {

/// The inputs of the pass besides its own images.
struct AlternateInputs {
    VkImageView depth = VK_NULL_HANDLE;
    VkImageLayout depth_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkBuffer constants = VK_NULL_HANDLE; // begins with a GpuConstants
};

class AlternatePass {
public:
    AlternatePass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    /// Makes the pipeline for masks of this format, if it is not there.
    void warmUp(VkFormat mask_format);
    /// Makes images like the mask if those that are there are not; then nothing of the frame before is known.
    void prepare(const ImageInfo& mask, std::size_t lights);
    /// The next frame has no frame before it.
    void forget();
    /// Where the visibility by this frame's maps alone is to be drawn; afterwards it is readable by fragment shaders.
    [[nodiscard]] const Image& target() const { return history_.now().visibility; }
    /// All layers. The mask is in COLOR_ATTACHMENT_OPTIMAL.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const AlternateInputs& inputs,
                const Image& mask);

private:
    struct LightHistory {
        bool known = false;
        MaskPlace place;
        glm::dvec3 direction_ws{0.0}; // direction of the maps that it was seen by
    };
    void writeSet(VkDescriptorSet set, const AlternateInputs& inputs);
    [[nodiscard]] Pipeline makePipeline(VkFormat mask_format);
    void recordLayer(VkCommandBuffer commands, const Plan& plan, std::uint32_t layer, const Image& mask);
    [[nodiscard]] glm::vec4 weightsOfBefore(const Plan& plan, std::uint32_t layer) const;
    void remember(const Plan& plan);

    Device& device_;
    VkPipelineCache cache_;
    Sampler sampler_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    // Few: of one light, of several.
    struct Made {
        VkFormat mask_format = VK_FORMAT_UNDEFINED;
        Pipeline pipeline;
    };
    std::vector<Made> pipelines_;
    std::vector<std::array<VkDescriptorSet, 2>> slots_; // by slot and turn
    MaskHistory history_;
    std::vector<LightHistory> lights_;
};

} // namespace gnomon::vulkan
