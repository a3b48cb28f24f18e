// SPDX-License-Identifier: Apache-2.0
// Shadows on surfaces that are shaded as they are drawn, by door 2 of docs/integrating.md. With Shading::forward these
// are all surfaces. Else they are the blended ones: the mask has one surface a pixel, and does not know what blends
// over it. They read the frame's maps in the pass that lights them.
#pragma once

#include "scene_data.h"

#include <vector>

namespace gnomon::host {

/// The bindings of the pass that reads maps: for each slot a set and its buffers.
class ForwardShadows {
public:
    /// Makes the pipeline of blended surfaces, for these options, where the scene has some. Throws Error.
    ForwardShadows(SceneData& scene, const ResolvedOptions& options, std::uint32_t slots);
    ~ForwardShadows() = default;
    ForwardShadows(const ForwardShadows&) = delete;
    ForwardShadows& operator=(const ForwardShadows&) = delete;

    /// Fills the slot's set for the frame that is recorded next, after ShadowRenderer::prepare(). Preconditions: the
    /// GPU has finished the slot's last frame, and the plan has views. Throws Error.
    void describe(std::uint32_t slot, const Plan& plan, const vulkan::ShadowRenderer& renderer);
    /// To be called outside of rendering, after ShadowRenderer::recordBounds().
    void recordViews(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan,
                     vulkan::ShadowRenderer& renderer) const;
    /// Binds set 2, inside rendering. Sets 0 and 1 are the scene's.
    void bind(VkCommandBuffer commands, std::uint32_t slot) const;
    [[nodiscard]] VkDescriptorSet set(std::uint32_t slot) const { return slots_[slot].set; }
    [[nodiscard]] const SurfacePipelines& blended() const { return of_blended_; }
    [[nodiscard]] const std::vector<vulkan::MemoryUse>& memory() const { return memory_.uses(); }

private:
    struct Slot {
        Buffer constants;
        Buffer lights;
        Buffer views;
        Buffer objects;
        VkDescriptorSet set = VK_NULL_HANDLE;
    };
    void makeSets();
    void writeSet(const Slot& slot, const vulkan::ShadowRenderer& renderer) const;

    const Gpu& gpu_;
    const Pipelines& pipelines_;
    Memory memory_;
    SurfacePipelines of_blended_;
    VkSampler map_sampler_;
    VkSampler texel_sampler_; // nearest, of blocks and tints
    OwnedDescriptorPool pool_;
    std::vector<Slot> slots_;
};

} // namespace gnomon::host
