// SPDX-License-Identifier: Apache-2.0
// Shared by the passes that make a map filterable: one layout for all of their shaders (gnomon/lib/filter_pass.glsl),
// compute and fragment, the pool of their descriptor sets, and the creation of their pipelines.
#pragma once

#include "descriptors.h"

#include <gnomon/pack/filter_passes.h>

namespace gnomon::vulkan {

/// The bindings of one set. All are always given [drivers: unwritten].
struct FilterBindings {
    VkImageView source = VK_NULL_HANDLE;
    bool source_is_depth = false;        // then in SHADER_READ_ONLY_OPTIMAL, else in GENERAL
    VkImageView target = VK_NULL_HANDLE; // view of a storage image in GENERAL
    VkBuffer blocks = VK_NULL_HANDLE;
    VkBuffer depth_layers = VK_NULL_HANDLE;
    VkBuffer kernel = VK_NULL_HANDLE;
    VkBuffer counts = VK_NULL_HANDLE; // BlurCounts, at dynamic offsets
};

class FilterLayout {
public:
    FilterLayout(Device& device, VkPipelineCache cache);

    /// Room for this many sets, all of them new. Sets that were made before are retired.
    void reset(std::uint32_t sets) { sets_.reset(sets); }
    [[nodiscard]] VkDescriptorSet makeSet(const FilterBindings& bindings);
    [[nodiscard]] Pipeline makeCompute(std::span<const std::uint32_t> spirv, const pack::FilterConstants& constants,
                                       const char* name);
    /// A triangle that covers the viewport, into one colour attachment.
    [[nodiscard]] Pipeline makeFragment(std::span<const std::uint32_t> spirv, const pack::FilterConstants& constants,
                                        VkFormat format, const char* name);
    /// Binds everything; `counts_offset` is that of BlurCounts in their buffer.
    void bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline, VkDescriptorSet set,
              std::uint32_t counts_offset, const shared::FilterPassPlace& place) const;
    [[nodiscard]] Device& device() const { return device_; }

private:
    Device& device_;
    VkPipelineCache cache_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    // Clamped. Depth formats need not be filterable, and are only ever fetched from.
    Sampler nearest_;
    Sampler linear_;
};

} // namespace gnomon::vulkan
