// SPDX-License-Identifier: Apache-2.0
// soften=converge: joins each frame's mask with the mean of those before it. Frames before count as far as they saw the
// same surface and nothing has moved that can have changed its light; else this frame counts alone.
#pragma once

#include "descriptors.h"
#include "mask_history.h"

#include <gnomon/shared/gpu_converge.h>

#include <array>

namespace gnomon::vulkan {

/// The inputs of the pass besides its own images.
struct ConvergeInputs {
    VkImageView depth = VK_NULL_HANDLE;
    VkImageLayout depth_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageView normal = VK_NULL_HANDLE; // VK_NULL_HANDLE: none
    VkBuffer constants = VK_NULL_HANDLE; // begins with a GpuConstants
};

class ConvergePass {
public:
    ConvergePass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    /// Makes the pipeline for masks of this format, if it is not there.
    void warmUp(VkFormat mask_format);
    /// Makes images like the mask if those that are there are not; then nothing of the frame before is known.
    void prepare(const ImageInfo& mask, std::size_t lights);
    /// The format of target(), by the mask's: floats, which have room for the packing of gnomon/shared/converge.h.
    [[nodiscard]] static VkFormat targetFormat(VkFormat mask_format);
    /// Over how many frames in a row, up to this one, neither the camera nor a light nor an object has moved.
    [[nodiscard]] std::uint32_t stood(const Plan& plan) const;
    /// Where this frame's visibility alone is to be drawn; afterwards it is to be readable by fragment shaders.
    [[nodiscard]] const Image& target() const { return target_; }
    /// All layers. The mask is in COLOR_ATTACHMENT_OPTIMAL.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const ConvergeInputs& inputs,
                const Image& mask);

private:
    /// A light of the last frame.
    struct LightBefore {
        bool known = false;
        Light light;
        MaskPlace place;
    };
    struct Slot {
        HostBuffer layers;                   // GpuConverge by layer of the mask
        std::array<VkDescriptorSet, 2> sets; // by turn
    };
    void writeSet(const Slot& slot, const ConvergeInputs& inputs);
    [[nodiscard]] Pipeline makePipeline(VkFormat mask_format, bool at_rest);
    [[nodiscard]] bool goesOn(const Plan& plan) const;
    [[nodiscard]] bool isAgain(const Plan& plan) const;
    [[nodiscard]] bool fill(const Slot& slot, const Plan& plan, bool has_normals);
    void fillLight(const Plan& plan, std::size_t index, std::uint32_t stood_frames, shared::GpuConverge& out) const;
    void recordLayer(VkCommandBuffer commands, std::uint32_t layer, const Image& mask);
    void remember(const Plan& plan, bool has_normals);

    Device& device_;
    VkPipelineCache cache_;
    Sampler sampler_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    // Few: of one light, of several.
    struct Made {
        VkFormat mask_format = VK_FORMAT_UNDEFINED;
        Pipeline moving;
        Pipeline at_rest;
    };
    std::vector<Made> pipelines_;
    std::vector<Slot> slots_;
    MaskHistory history_;
    Image target_;
    // The last frame's data.
    std::vector<LightBefore> lights_;
    std::uint64_t planner_ = 0; // 0: there is none
    std::uint64_t number_ = 0;
    bool had_normals_ = false;
    std::uint32_t stood_ = 0;
};

} // namespace gnomon::vulkan
