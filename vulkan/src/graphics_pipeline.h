// SPDX-License-Identifier: Apache-2.0
// Graphics pipelines for dynamic rendering, with what all of ours have in common filled in.
#pragma once

#include "device.h"

namespace gnomon::vulkan {

struct GraphicsState {
    std::span<const VkPipelineShaderStageCreateInfo> stages;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::span<const VkVertexInputBindingDescription> bindings;
    std::span<const VkVertexInputAttributeDescription> attributes;
    VkFormat colour_format = VK_FORMAT_UNDEFINED; // UNDEFINED: no colour attachment
    VkFormat second_format = VK_FORMAT_UNDEFINED; // of a second colour attachment, likewise
    VkColorComponentFlags colour_mask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                                        VK_COLOR_COMPONENT_A_BIT; // what is written of it
    VkFormat depth_format = VK_FORMAT_UNDEFINED; // UNDEFINED: no depth; else tested LESS_OR_EQUAL and written
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool shade_samples = false;               // the fragment shader runs for each
    VkCullModeFlags cull = VK_CULL_MODE_NONE; // counter-clockwise is front
    bool depth_clamp = false;
    VkPipelineCache cache = VK_NULL_HANDLE;
    const char* name = "";
};

/// Viewport and scissor are dynamic.
[[nodiscard]] Pipeline makeGraphicsPipeline(Device& device, const GraphicsState& state);

} // namespace gnomon::vulkan
