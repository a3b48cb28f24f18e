// SPDX-License-Identifier: Apache-2.0
// soften=blur: blurs layers of the finished mask in place. All layers and lights share two images of one layer, and at
// full size one.
#pragma once

#include "descriptors.h"

#include <gnomon/pack/soften_draws.h>

#include <array>

namespace gnomon::vulkan {

/// The inputs of the pass besides the mask and images of its own.
struct SoftenInputs {
    VkImageView depth = VK_NULL_HANDLE;
    VkImageLayout depth_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageView normal = VK_NULL_HANDLE; // VK_NULL_HANDLE: none
    VkBuffer constants = VK_NULL_HANDLE; // begins with a GpuConstants
};

/// The properties that distinguish the pass's pipelines.
struct SoftenPipelineKey {
    VkFormat format = VK_FORMAT_UNDEFINED; // format of the target
    std::int32_t scale = 1;
    bool edge_aware = true;
    bool normals = true;
    std::int32_t kernel = 0;       // screen_blur.h
    bool spreads = false;          // soften_spread.frag, else soften.frag
    bool chooses_channels = false; // GraphicsState::chooses_channels

    bool operator==(const SoftenPipelineKey&) const = default;
};

class SoftenPass {
public:
    SoftenPass(Device& device, std::uint32_t frames_in_flight, VkPipelineCache cache);

    /// Makes the pipelines for masks of this format. `some`: other lights may share their layers.
    void warmUp(VkFormat mask_format, const ScreenBlurOptions& blur, bool normals, bool some);
    /// Makes images for any of the plan's options, if those that are there do not fit.
    void prepare(const ImageInfo& mask, const Plan& plan);
    /// Are the images there that this plan needs for such a mask?
    [[nodiscard]] bool holds(const ImageInfo& mask, const Plan& plan) const;
    /// The mask is in SHADER_READ_ONLY_OPTIMAL and visible to fragment shaders, before and afterwards; `readers` are
    /// the stages that may read it, by sampling or as a transfer.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const SoftenInputs& inputs,
                const Image& mask, VkPipelineStageFlags2 readers);

private:
    enum Source : std::uint32_t { kMask, kFirst, kSecond, kSourceCount };
    struct Slot {
        std::array<VkDescriptorSet, kSourceCount> sets;
    };
    struct Made {
        SoftenPipelineKey key;
        Pipeline pipeline;
    };
    /// Extents that the two images need; {0, 0}: none.
    using Extents = std::array<VkExtent2D, 2>;

    [[nodiscard]] static Extents extentsFor(const ImageInfo& mask, const Plan& plan);
    [[nodiscard]] VkPipeline pipeline(const SoftenPipelineKey& key);
    void writeSets(const Slot& slot, const SoftenInputs& inputs, const Image& mask);
    void recordDraw(VkCommandBuffer commands, const Slot& slot, const pack::SoftenDraw& draw, bool normals,
                    const Image& mask, VkPipelineStageFlags2 readers);

    Device& device_;
    VkPipelineCache cache_;
    Sampler nearest_;
    Sampler linear_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    HostBuffer points_; // points of the disc, two to a vec4
    std::vector<Slot> slots_;
    std::vector<Made> pipelines_;
    std::vector<pack::SoftenDraw> draws_; // for the frame that is being recorded
    std::array<Image, 2> images_;
};

} // namespace gnomon::vulkan
