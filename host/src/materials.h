// SPDX-License-Identifier: Apache-2.0
// A scene's materials as descriptor sets, and their demands on a pipeline.
#pragma once

#include "textures.h"

#include <glm/vec4.hpp>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::host {

/// Laid out as MaterialData in host/shaders/material.glsl (std140).
struct MaterialData {
    glm::vec4 base_colour;
    glm::vec4 emissive; // w: normal scale
    glm::vec4 numbers;  // metallic, roughness, occlusion strength, alpha cutoff
    glm::vec4 model;    // x: 0 metallic-roughness, 1 phong, 2 unlit; y: phong exponent; z: lit_by_night
    std::array<std::array<glm::vec4, 2>, 5> places;
};
static_assert(sizeof(MaterialData) == 16 * 14);

/// Few, because a software rasteriser compiles each of them when the program starts.
enum class SurfaceKind : std::uint8_t { plain, textured, masked, full, full_masked, count };

struct MaterialFacts {
    SurfaceKind kind = SurfaceKind::plain;
    bool two_sided = false;
    bool blended = false;
    bool emits = false;
    bool physical = true; // metallic-roughness
    bool fades = false;   // into the sky (ShadingModel::horizon)
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorSet caster_set = VK_NULL_HANDLE; // masked and blended materials: the base colour texture alone
};

class Materials {
public:
    Materials(const Gpu& gpu, Memory& memory, Uploader& uploader, Textures& textures, const scene::Scene& scene);
    ~Materials() = default;
    Materials(const Materials&) = delete;
    Materials& operator=(const Materials&) = delete;

    /// One per scene material, then the default material.
    [[nodiscard]] const std::vector<MaterialFacts>& all() const { return facts_; }
    [[nodiscard]] std::uint32_t indexOf(std::uint32_t material) const
    {
        return material == scene::kNone ? static_cast<std::uint32_t>(facts_.size()) - 1 : material;
    }
    [[nodiscard]] VkDescriptorSetLayout layout() const { return layout_.get(); }

private:
    void makeLayouts(const DebugNames& names);
    [[nodiscard]] OwnedSetLayout makeLayout(std::span<const VkDescriptorSetLayoutBinding> bindings) const;
    void writeSet(const scene::Material& material, Textures& textures, VkDeviceSize offset, MaterialFacts& facts);

    const Gpu& gpu_;
    VkDevice device_;
    Buffer data_;
    OwnedSetLayout layout_;
    OwnedSetLayout caster_layout_;
    OwnedDescriptorPool pool_;
    std::vector<MaterialFacts> facts_;
};

} // namespace gnomon::host
