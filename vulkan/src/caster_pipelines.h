// SPDX-License-Identifier: Apache-2.0
// The pipelines that CasterDrawer draws with, made when a plan first needs them.
#pragma once

#include "descriptors.h"

#include <gnomon/vulkan/caster_drawer.h>
#include <gnomon/vulkan/classic_pass.h>

#include <array>

namespace gnomon::vulkan {

/// The properties that distinguish pipelines.
struct CasterPipelineKey {
    MapPassFormats formats;
    ClassicFormats classic;
    bool perspective = false;
    bool masked = false;   // or blended: it has a texture
    bool coloured = false; // CasterBatch::vertex_colours, of what is masked
    bool clipped = false;  // CasterBatch::clip_planes
    bool clamp = true;     // casters before the near plane are clamped onto it
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    TexelPart part = TexelPart::whole;
    bool placed = false;  // MapPass::placement
    bool layered = false; // MapPass::view_count above 1; then `part` is whole

    bool operator==(const CasterPipelineKey&) const = default;
};

/// Push constants: caster.vert, Material.
struct CasterMaterial {
    glm::vec4 uv_u{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec4 uv_v{0.0F, 1.0F, 0.0F, 0.0F};
    float cutoff = 0.5F;         // for blended ones: 1 where they are stained
    std::int32_t first_view = 0; // first of several views that the GPU has placed; pushed apart from the rest
    glm::vec2 unused{0.0F};
    glm::vec4 tint{1.0F}; // caster_tint.frag
    std::array<glm::vec4, 2> clip_planes{kNoClipPlane, kNoClipPlane};
};
static_assert(sizeof(CasterMaterial) == 96);
inline constexpr VkShaderStageFlags kMaterialStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Vertex buffer of MapPass::placement.
inline constexpr std::uint32_t kPlacementBinding = 3;

/// Vertex buffers of CasterGeometry::pieces and colours.
inline constexpr std::uint32_t kPieceBinding = 4;
inline constexpr std::uint32_t kColourBinding = 5;

class CasterPipelines {
public:
    CasterPipelines(Device& device, const CasterDrawerOptions& options);
    void ensure(const CasterPipelineKey& key);
    /// Precondition: ensure(key).
    [[nodiscard]] VkPipeline get(const CasterPipelineKey& key) const;
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout textureSetLayout() const { return textures_.layout(); }
    /// Set 1 of passes of several views that the GPU has placed: GpuFittedView by view of the plan.
    [[nodiscard]] DescriptorSets& places() { return places_; }
    /// Which set ClassicPass::first_surface is.
    static constexpr std::uint32_t kFirstSurfaceSet = 2;

private:
    struct Made {
        CasterPipelineKey key;
        Pipeline pipeline;
    };

    [[nodiscard]] Pipeline make(const CasterPipelineKey& key);

    Device& device_;
    CasterDrawerOptions options_;
    DescriptorSets textures_; // for its layout: the host makes the sets
    DescriptorSets places_;
    DescriptorSets first_surface_; // for its layout alone
    PipelineLayout layout_;
    std::vector<Made> made_;
};

} // namespace gnomon::vulkan
