// SPDX-License-Identifier: Apache-2.0
// The null driver's checks of new objects: whether they need something that the device lacks.
#include "null_state.h"

#include <algorithm>

namespace gnomon::test {
namespace {

// Numbers of SPIR-V's specification.
constexpr std::uint32_t kHeaderWords = 5;
enum Op : std::uint32_t { kExecutionMode = 16, kCapability = 17, kConstant = 43, kExecutionModeId = 331 };
enum Mode : std::uint32_t { kLocalSize = 17, kLocalSizeId = 38 };
enum Capability : std::uint32_t {
    kClipDistance = 32,
    kSampleRateShading = 35,
    kWriteWithoutFormat = 56,
    kShaderLayer = 69,
    kViewportIndexLayer = 5254
};

/// Calls `see` with each instruction's words: by hand, for a driver's memory is none of what tests let fail.
template <class See>
void eachInstruction(std::span<const std::uint32_t> words, See&& see)
{
    for (std::size_t i = kHeaderWords; i < words.size();) {
        const std::size_t length = std::max<std::size_t>(words[i] >> 16U, 1);
        see(words[i] & 0xFFFFU, words.subspan(i, length));
        i += length;
    }
}

std::uint32_t constantOf(std::span<const std::uint32_t> words, std::uint32_t id)
{
    std::uint32_t value = 1;
    eachInstruction(words, [&](std::uint32_t op, std::span<const std::uint32_t> one) {
        value = op == kConstant && one[2] == id ? one[3] : value;
    });
    return value;
}

/// Threads of a compute shader's group; 1 of other shaders.
std::uint32_t groupThreads(std::span<const std::uint32_t> words)
{
    std::uint32_t threads = 1;
    eachInstruction(words, [&](std::uint32_t op, std::span<const std::uint32_t> one) {
        if (op == kExecutionMode && one[2] == kLocalSize) {
            threads = one[3] * one[4] * one[5];
        } else if (op == kExecutionModeId && one[2] == kLocalSizeId) {
            threads = constantOf(words, one[3]) * constantOf(words, one[4]) * constantOf(words, one[5]);
        }
    });
    return threads;
}

} // namespace

VkFormatFeatureFlags NullDriver::Impl::featuresOf(VkFormat format) const
{
    return format == limits.lacks_format && format != VK_FORMAT_UNDEFINED ? 0 : ~hidden_features;
}

void NullDriver::Impl::checkShader(std::span<const std::uint32_t> words)
{
    const VkPhysicalDeviceFeatures& lacks = limits.lacks;
    eachInstruction(words, [&](std::uint32_t op, std::span<const std::uint32_t> one) {
        if (op == kCapability) {
            const std::uint32_t takes = one[1];
            lackIf(takes == kClipDistance && lacks.shaderClipDistance != VK_FALSE);
            lackIf(takes == kSampleRateShading && lacks.sampleRateShading != VK_FALSE);
            lackIf(takes == kWriteWithoutFormat && lacks.shaderStorageImageWriteWithoutFormat != VK_FALSE);
            lackIf((takes == kShaderLayer || takes == kViewportIndexLayer) && limits.lacks_output_layer);
        }
    });
    lackIf(groupThreads(words) > limits.group_threads);
}

void NullDriver::Impl::checkImage(const VkImageCreateInfo& info)
{
    constexpr std::pair<VkImageUsageFlags, VkFormatFeatureFlags> kUses[] = {
        {VK_IMAGE_USAGE_SAMPLED_BIT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT},
        {VK_IMAGE_USAGE_STORAGE_BIT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT},
        {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT},
        {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT}};
    for (const auto& [usage, feature] : kUses) {
        lackIf((info.usage & usage) != 0 && (featuresOf(info.format) & feature) == 0);
    }
}

void NullDriver::Impl::checkPipeline(const VkGraphicsPipelineCreateInfo& info)
{
    const VkPhysicalDeviceFeatures& lacks = limits.lacks;
    const auto* const raster = info.pRasterizationState;
    const auto* const depth = info.pDepthStencilState;
    const auto* const samples = info.pMultisampleState;
    lackIf(raster != nullptr && raster->depthClampEnable == VK_TRUE && lacks.depthClamp != VK_FALSE);
    lackIf(depth != nullptr && depth->depthBoundsTestEnable == VK_TRUE && lacks.depthBounds != VK_FALSE);
    lackIf(samples != nullptr && samples->sampleShadingEnable == VK_TRUE && lacks.sampleRateShading != VK_FALSE);
}

void NullDriver::Impl::checkLayout(const VkDescriptorSetLayoutCreateInfo& info)
{
    for (const VkShaderStageFlags stage :
         {VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT, VK_SHADER_STAGE_COMPUTE_BIT}) {
        std::uint32_t buffers = 0;
        for (const VkDescriptorSetLayoutBinding& binding : std::span(info.pBindings, info.bindingCount)) {
            const bool is_one =
                binding.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER && (binding.stageFlags & stage) != 0;
            buffers += is_one ? binding.descriptorCount : 0;
        }
        lackIf(buffers > limits.storage_buffers);
    }
}

} // namespace gnomon::test
