// SPDX-License-Identifier: Apache-2.0
// Maps of a stepping sun by turns: the visibility by this frame's maps of one position is joined with the last frame's
// for the other position, moved to where its surfaces are now. This frame counts alone where the last frame did not see
// the surface, in the first frame, and where the last frame had another pair of positions.
#pragma once

#include "descriptors.h"
#include "mask_history.h"
#include "mask_step.h"

#include <array>

namespace gnomon::vulkan {

class AlternatePass final : public FrameJoiner {
public:
    AlternatePass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    void warmUp(const MaskKind& mask) override;
    /// With new images nothing of the frame before is known.
    void prepare(const Plan& plan, const ImageInfo& mask, const MaskShape& shape) override;
    void forget() override;
    [[nodiscard]] const Image& target() const override { return history_.now().visibility; }
    void record(const MaskJob& job, const Image& mask) override;

private:
    struct LightHistory {
        bool known = false;
        MaskPlace place;
        glm::dvec3 direction_ws{0.0}; // direction of the maps that it was seen by
    };
    void writeSet(VkDescriptorSet set, const MaskJob& job);
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
