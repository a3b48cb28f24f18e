// SPDX-License-Identifier: Apache-2.0
// Descriptor sets of one kind: one descriptor at each binding, seen by the same shader stages. All passes have such
// sets.
#pragma once

#include "device.h"

#include <array>

namespace gnomon::vulkan {

/// By binding.
using DescriptorTypes = std::span<const VkDescriptorType>;

/// The layout of one kind of set, and the pool that they are taken from.
class DescriptorSets {
public:
    static constexpr std::size_t kMostBindings = 14;

    DescriptorSets() = default;
    /// Without room for any set.
    DescriptorSets(Device& device, DescriptorTypes types, VkShaderStageFlags stages);

    [[nodiscard]] VkDescriptorSetLayout layout() const { return layout_.get(); }
    /// Room for this many, all of them new. Those that were taken before are retired.
    void reset(std::uint32_t count);
    /// Takes one. Throws Error when there is no room left.
    [[nodiscard]] VkDescriptorSet take(const char* name);

    /// One binding's new content: an image of that binding's type, or a buffer.
    struct Write {
        std::uint32_t binding = 0;
        VkDescriptorImageInfo image{};
        VkDescriptorBufferInfo buffer{};
    };
    [[nodiscard]] static Write image(std::uint32_t binding, VkSampler sampler, VkImageView view, VkImageLayout layout)
    {
        return {binding, {sampler, view, layout}, {}};
    }
    [[nodiscard]] static Write buffer(std::uint32_t binding, VkBuffer buffer, VkDeviceSize range = VK_WHOLE_SIZE,
                                      VkDeviceSize offset = 0)
    {
        return {binding, {}, {buffer, offset, range}};
    }
    /// No frame that uses the set may be pending.
    void write(VkDescriptorSet set, std::span<const Write> writes) const;

private:
    Device* device_ = nullptr;
    std::array<VkDescriptorType, kMostBindings> types_{};
    std::size_t type_count_ = 0;
    SetLayout layout_;
    DescriptorPool pool_;
};

/// The layout of pipelines with one set and `push_bytes` of push constants for the same stages; 0: none.
[[nodiscard]] PipelineLayout makePipelineLayout(Device& device, VkDescriptorSetLayout set, VkShaderStageFlags stages,
                                                std::uint32_t push_bytes);

} // namespace gnomon::vulkan
