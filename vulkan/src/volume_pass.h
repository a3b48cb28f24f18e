// SPDX-License-Identifier: Apache-2.0
// Lights with filter volumes: their casters' shadow volumes are counted in a stencil buffer of our own, beside a copy
// of the camera's depth, and the count becomes the light's channel the mask's format.
#pragma once

#include "descriptors.h"
#include "device.h"
#include "stand_in.h"

#include <gnomon/pack/volume_draws.h>

#include <vector>

namespace gnomon::vulkan {

/// The lights' constants: GpuConstants by options.
struct ConstantsRef {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize stride = 0; // bytes
};

class VolumePassRecorder {
public:
    VolumePassRecorder(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    /// Has the plan such lights?
    [[nodiscard]] static bool draws(const Plan& plan);
    /// Makes the depth buffer if the size changed, sets for the plan's options, and the pipelines that inputs of this
    /// shape need. Throws Error where the device has no such depth buffer.
    void prepare(const Plan& plan, VkExtent2D screen, VkFormat mask_format, const MaskShape& shape);
    void warmUp(VkFormat mask_format, std::uint32_t channels, const MaskShape& shape);
    /// All of them, to `target`, which is in COLOR_ATTACHMENT_OPTIMAL and has what the other lights have drawn.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                const ConstantsRef& constants, const StandIn& no_ids, const Image& target);

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
    struct Job {
        VkCommandBuffer commands;
        std::uint32_t slot;
        const Plan& plan;
        const MaskInputs& inputs;
        VkFormat format; // the mask's format
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
    void writeSets(std::uint32_t slot, const MaskInputs& inputs, const ConstantsRef& constants, const StandIn& no_ids);
    void beginLayer(VkCommandBuffer commands, const Image& target, std::uint32_t layer);
    void copyDepth(const Job& job, std::uint32_t layer);
    void countLight(const Job& job, const pack::VolumeDraw& draw);
    void drawLight(const Job& job, const pack::VolumeDraw& draw);

    Device& device_;
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
