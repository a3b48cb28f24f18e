// SPDX-License-Identifier: Apache-2.0
// Lights with filter volumes: their casters' shadow volumes are counted in a stencil buffer of our own, beside a copy
// of the camera's depth, and the count becomes the light's channel the mask's format.
#pragma once

#include "descriptors.h"
#include "device.h"
#include "mask_step.h"

#include <gnomon/pack/volume_draws.h>
#include <gnomon/vulkan/volume_drawer.h>

#include <vector>

namespace gnomon::vulkan {

class VolumePassRecorder final : public MaskStep {
public:
    /// `draw` has to live longer.
    VolumePassRecorder(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache, const DrawVolumes& draw);

    void warmUp(const MaskKind& mask) override;
    /// Throws Error where the device has no depth buffer with stencil.
    void prepare(const Plan& plan, const ImageInfo& mask, const MaskShape& shape) override;
    /// Adds to what the other lights have drawn.
    void record(const MaskJob& job, const Image& mask) override;

private:
    struct Key {
        VkFormat format = VK_FORMAT_UNDEFINED; // the mask's format
        std::uint32_t channels = 0;
        MaskShape shape;
        bool inside = false;
    };
    struct Made {
        Key key;
        Pipeline pipeline;
    };
    struct Copy {
        VkFormat format = VK_FORMAT_UNDEFINED; // the mask's format
        bool smooth = false;                   // MaskShape::smooth
        Pipeline pipeline;
    };
    void makeSets(std::uint32_t options);
    [[nodiscard]] VkPipeline maskPipeline(const Key& key);
    [[nodiscard]] Pipeline makeMaskPipeline(const Key& key);
    [[nodiscard]] VkPipeline copyPipeline(VkFormat format, bool smooth);
    [[nodiscard]] Pipeline makeCopyPipeline(VkFormat format, bool smooth);
    [[nodiscard]] VkDescriptorSet setOf(std::uint32_t slot, std::uint32_t options) const
    {
        return slot_sets_[slot * options_ + options];
    }
    void writeSets(const MaskJob& job);
    void beginLayer(VkCommandBuffer commands, const Image& target, std::uint32_t layer);
    void copyDepth(const MaskJob& job, VkFormat format, std::uint32_t layer);
    void countLight(const MaskJob& job, VkFormat format, const pack::VolumeDraw& draw);
    void drawLight(const MaskJob& job, VkFormat format, const pack::VolumeDraw& draw);

    Device& device_;
    const DrawVolumes& draw_;
    /// Its 8 bits of stencil count modulo 256: a pixel in as many volumes as that would be lit.
    VkFormat depth_stencil_;
    std::uint32_t slot_count_;
    VkPipelineCache cache_;
    Sampler nearest_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    ShaderModule triangle_;
    std::uint32_t options_ = 0;
    std::vector<VkDescriptorSet> slot_sets_; // by slot, and by options in it
    std::vector<Made> pipelines_;
    std::vector<Copy> copies_;
    Image depth_;
    std::vector<pack::VolumeDraw> draws_; // draws for the frame that is being recorded
};

} // namespace gnomon::vulkan
