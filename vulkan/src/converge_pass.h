// SPDX-License-Identifier: Apache-2.0
// soften=converge: joins each frame's mask with the mean of those before it. Frames before count as far as they saw the
// same surface and nothing has moved that can have changed its light; else this frame counts alone.
#pragma once

#include "descriptors.h"
#include "mask_history.h"
#include "mask_step.h"

#include <gnomon/shared/gpu_converge.h>

#include <array>

namespace gnomon::vulkan {

class ConvergePass final : public FrameJoiner {
public:
    ConvergePass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    void warmUp(const MaskKind& mask) override;
    /// With new images nothing of the frame before is known.
    void prepare(const Plan& plan, const ImageInfo& mask, const MaskShape& shape) override;
    /// The format of target(), by the mask's: floats, which have room for the packing of gnomon/shared/converge.h.
    [[nodiscard]] static VkFormat targetFormat(VkFormat mask_format);
    /// Over how many frames in a row, up to this one, neither the camera nor a light nor an object has moved.
    [[nodiscard]] std::uint32_t stood(const Plan& plan) const;
    [[nodiscard]] const Image& target() const override { return target_; }
    void forget() override { planner_ = 0; }
    void record(const MaskJob& job, const Image& mask) override;

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
    void writeSet(const Slot& slot, const MaskJob& job);
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
