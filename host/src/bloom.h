// SPDX-License-Identifier: Apache-2.0
// The images and passes of bloom; made only where it is wanted. The arithmetic is in host/shaders/bloom_weights.h.
#pragma once

#include "commands.h"

#include "host/frame_renderer.h"

#include <string_view>
#include <vector>

namespace gnomon::host {

/// The number of halvings of a picture of this size: until its shorter side has fewer than two texels, one at least.
[[nodiscard]] std::uint32_t bloomLevels(VkExtent2D shown, std::uint32_t wanted);

/// Read by compute shaders too.
inline constexpr Access kSampledByAll{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

class Bloom {
public:
    /// `light`: radiance, of the size of the picture or twice that on each side, see `average_four`.
    Bloom(const Gpu& gpu, Memory& memory, const BloomOptions& options, const Image& light, VkExtent2D shown,
          bool average_four, VkSampler linear);
    ~Bloom() = default;
    Bloom(const Bloom&) = delete;
    Bloom& operator=(const Bloom&) = delete;

    /// `light` is readable by compute shaders; afterwards result() is readable as kSampled.
    void record(VkCommandBuffer commands) const;
    /// Half the picture's size: the sum of all levels.
    [[nodiscard]] const Image& result() const { return levels_.front(); }

private:
    struct Step {
        VkPipeline pipeline = VK_NULL_HANDLE;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::size_t target = 0; // level
        bool adds = false;      // to the level's content
    };
    void makeImages(Memory& memory, VkExtent2D shown, std::uint32_t count);
    void makeLayouts();
    void makeSteps(const BloomOptions& options, const Image& light, bool average_four, VkSampler linear);
    VkPipeline makePipeline(const char* name, std::string_view shader, std::span<const std::uint32_t> constants);
    VkDescriptorSet makeSet(VkImageView source, VkImageLayout layout, VkSampler sampler, VkImageView target);

    const Gpu& gpu_;
    const DebugNames& names_;
    std::vector<Image> levels_; // each half of the one before
    std::vector<Step> steps_;   // down the chain and up again
    std::vector<OwnedPipeline> pipelines_;
    OwnedSetLayout set_layout_;
    OwnedPipelineLayout layout_;
    OwnedDescriptorPool pool_;
};

} // namespace gnomon::host
