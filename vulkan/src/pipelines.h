// SPDX-License-Identifier: Apache-2.0
// Pipelines, with what all of ours have in common filled in: graphics for dynamic rendering, and compute.
#pragma once

#include "device.h"

#include <array>

namespace gnomon::vulkan {

using TwoStages = std::array<VkPipelineShaderStageCreateInfo, 2>;

/// A vertex and a fragment shader; `specialisation`, of the latter, must live as long as this is used.
[[nodiscard]] TwoStages stagesOf(const ShaderModule& vertex, const ShaderModule& fragment,
                                 const VkSpecializationInfo* specialisation = nullptr);

struct GraphicsState {
    std::span<const VkPipelineShaderStageCreateInfo> stages;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::span<const VkVertexInputBindingDescription> bindings;
    std::span<const VkVertexInputAttributeDescription> attributes;
    VkFormat colour_format = VK_FORMAT_UNDEFINED; // UNDEFINED: no colour attachment
    VkFormat second_format = VK_FORMAT_UNDEFINED; // UNDEFINED: no second colour attachment
    VkFormat third_format = VK_FORMAT_UNDEFINED;
    VkColorComponentFlags colour_mask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                                        VK_COLOR_COMPONENT_A_BIT; // the channels of it that are written
    bool keeps_least = false;      // each channel keeps the lesser of its old and new values
    bool takes_away = false;       // the new value is subtracted from the old one
    bool chooses_channels = false; // channels are written whose dynamic blend constant is 1; those with 0 stay
    bool tints = false; // colours multiply what is there, and of alpha the lesser one stays; depth is not written
    VkFormat depth_format = VK_FORMAT_UNDEFINED; // UNDEFINED: no depth; else tested LESS_OR_EQUAL and written
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool shade_samples = false;               // the fragment shader runs for each
    VkCullModeFlags cull = VK_CULL_MODE_NONE; // counter-clockwise is front
    bool depth_clamp = false;
    /// In place of what `depth_format` says of tests; its stencil is of `stencil_format`.
    const VkPipelineDepthStencilStateCreateInfo* depth_stencil = nullptr;
    VkFormat stencil_format = VK_FORMAT_UNDEFINED;
    float depth_bias_slope = 0.0F;
    VkPipelineCache cache = VK_NULL_HANDLE;
    const char* name = "";
};

/// Viewport and scissor are dynamic; so are the blend constants with chooses_channels, and depth bounds where
/// `depth_stencil` tests them.
[[nodiscard]] Pipeline makeGraphicsPipeline(Device& device, const GraphicsState& state);

struct ComputeState {
    std::span<const std::uint32_t> spirv;
    const VkSpecializationInfo* specialisation = nullptr;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipelineCache cache = VK_NULL_HANDLE;
    const char* name = "";
};
[[nodiscard]] Pipeline makeComputePipeline(Device& device, const ComputeState& state);

} // namespace gnomon::vulkan
