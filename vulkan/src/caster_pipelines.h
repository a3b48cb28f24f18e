// SPDX-License-Identifier: Apache-2.0
// The pipelines that CasterDrawer draws with, made when a plan first needs them.
#pragma once

#include "device.h"

#include <gnomon/vulkan/caster_drawer.h>

#include <array>

namespace gnomon::vulkan {

/// What distinguishes them.
struct CasterPipelineKey {
    bool perspective = false;
    bool masked = false;
    bool clamp = true; // casters before the near plane are clamped onto it
    bool cull = false;
    TexelPart part = TexelPart::whole;
    bool placed = false; // MapPass::placement
    [[nodiscard]] std::size_t index() const
    {
        const std::size_t parts = static_cast<std::size_t>(part) + (placed ? 3U : 0U);
        return (perspective ? 1U : 0U) | (masked ? 2U : 0U) | (clamp ? 4U : 0U) | (cull ? 8U : 0U) | parts << 4;
    }
};

/// Push constants of masked casters: caster_vertex.glsl, Material.
struct CasterMaterial {
    glm::vec4 uv_u{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec4 uv_v{0.0F, 1.0F, 0.0F, 0.0F};
    float cutoff = 0.5F;
};
inline constexpr VkShaderStageFlags kMaterialStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Vec4s that an instance brings: rows x, y and metric; a perspective view adds rows z and w before the metric.
[[nodiscard]] constexpr std::uint32_t instanceRows(bool perspective)
{
    return perspective ? 5 : 3;
}

/// Vertex buffer of MapPass::placement.
inline constexpr std::uint32_t kPlacementBinding = 3;

class CasterPipelines {
public:
    CasterPipelines(Device& device, const CasterDrawerOptions& options);
    void ensure(CasterPipelineKey key);
    /// Precondition: ensure(key).
    [[nodiscard]] VkPipeline get(CasterPipelineKey key) const { return pipelines_[key.index()].get(); }
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout textureSetLayout() const { return set_layout_.get(); }

private:
    [[nodiscard]] Pipeline make(CasterPipelineKey key);

    Device& device_;
    CasterDrawerOptions options_;
    SetLayout set_layout_;
    PipelineLayout layout_;
    std::array<Pipeline, 96> pipelines_;
};

} // namespace gnomon::vulkan
