// SPDX-License-Identifier: Apache-2.0
// The lists of a compact mask, for the shading pass.
#pragma once

#include "scene_data.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <vector>

namespace gnomon::host {

class MaskTiles {
public:
    MaskTiles(SceneData& scene, std::uint32_t slots);

    /// To be called after ShadowRenderer::recordMask() of the same slot, once the GPU has finished the slot's last
    /// frame.
    void describe(std::uint32_t slot, const vulkan::BufferRef& tiles) const;
    /// Binds sets 0 and 1 of Pipelines::compact_layout.
    void bind(VkCommandBuffer commands, std::uint32_t slot, VkDescriptorSet frame_set) const;

private:
    const Gpu& gpu_;
    const Pipelines& pipelines_;
    OwnedDescriptorPool pool_;
    std::vector<VkDescriptorSet> sets_; // by slot
};

} // namespace gnomon::host
