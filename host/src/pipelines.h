// SPDX-License-Identifier: Apache-2.0
// The graphics pipelines that draw a scene, shared by all who do: each is made once, and only where it is needed.
#pragma once

#include "draw_table.h"

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::host {

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat kLightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kPictureFormat = VK_FORMAT_R8G8B8A8_UNORM;
/// Base colour and occlusion; geometric and shading normal; material; ids; MaskInputs::smooth.
inline constexpr std::array<VkFormat, 5> kGBufferFormats{VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_SNORM,
                                                         VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R32G32_UINT,
                                                         VK_FORMAT_R16G16B16A16_SNORM};

/// What gnomon/visibility.glsl wants bound: constants, maps, lights, views, layers of depth, blocks, tints, objects.
inline constexpr std::array<VkDescriptorType, 8> kMapsBindings{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

/// Instance-rate vertex data of host/shaders/scene.vert.
struct InstanceData {
    glm::vec4 row_x; // eye-relative from object
    glm::vec4 row_y;
    glm::vec4 row_z;
    std::uint32_t id = 0;          // object + 1
    std::uint32_t receiver_id = 0; // the same where the object receives, else 0
    std::uint32_t tints = 0;       // 1: it is a blended caster
    std::uint32_t unused = 0;
};
static_assert(sizeof(InstanceData) == 64);

/// What the tone pass does beside its curve.
struct ToneFacts {
    bool average_four = false;
    float bloom = 0.0F; // what the bloom's sum is multiplied by; 0: none
    float bloom_radius = 1.0F;

    bool operator==(const ToneFacts&) const = default;
};

/// For objects that nothing cuts, and for those that clip planes do; null where the scene has none.
struct SurfacePipelines {
    VkPipeline whole = VK_NULL_HANDLE;
    VkPipeline cut = VK_NULL_HANDLE;

    [[nodiscard]] VkPipeline of(const Batch& batch) const { return batch.cut != 0 ? cut : whole; }
};

class Pipelines {
public:
    Pipelines(const Gpu& gpu, const DebugNames& names, const Materials& materials, const DrawTable& table);
    ~Pipelines() = default;
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;

    [[nodiscard]] VkPipeline gbuffer(const Batch& batch) const
    {
        return gbuffer_[static_cast<std::size_t>(batch.kind)].of(batch);
    }
    SurfacePipelines blended; // lit without shadow
    SurfacePipelines emissive;
    VkPipeline sky = VK_NULL_HANDLE;

    // Compiled when first asked for, which is not to be while a frame is recorded.
    /// The shading pass made for this many lights. Phong and unlit surfaces are left out where the scene has none.
    /// `reflection_phong`: Shading.
    [[nodiscard]] VkPipeline shadeFor(std::size_t lights, bool all_directional, bool reflection_phong);
    /// Blended surfaces in the shadow of maps of this filter. Precondition: the scene has some.
    [[nodiscard]] SurfacePipelines shadowedFor(const ResolvedOptions& options);
    /// The same for a compact mask.
    [[nodiscard]] VkPipeline shadeCompact(bool reflection_phong);
    [[nodiscard]] VkPipeline toneFor(const ToneFacts& facts);
    [[nodiscard]] VkPipeline fxaa();

    OwnedSetLayout frame_layout;
    OwnedPipelineLayout scene_layout;   // set 0 frame, set 1 material; pushed: scene::ClipPlanes of what is cut
    OwnedPipelineLayout screen_layout;  // set 0 frame
    OwnedSetLayout tiles_layout;        // of a compact mask: ShadowRenderer::maskTiles()
    OwnedPipelineLayout compact_layout; // as screen_layout, and set 1 tiles
    // Null when the scene has no blended surface.
    OwnedSetLayout maps_layout;          // the bindings of gnomon/visibility.glsl
    OwnedPipelineLayout shadowed_layout; // as scene_layout, and set 2 maps; pushed as there

private:
    void makeLayouts(VkDescriptorSetLayout material);
    void makeCompactLayout();
    void makeShadowedLayout(VkDescriptorSetLayout material);
    [[nodiscard]] OwnedPipelineLayout makeLayout(std::span<const VkDescriptorSetLayout> sets,
                                                 bool of_scene = false) const;
    [[nodiscard]] OwnedShader module(std::string_view name) const;
    struct Wish;
    [[nodiscard]] static Wish blendedWish();
    VkPipeline make(const Wish& wish);
    /// `cut`: some are.
    SurfacePipelines makeSurface(Wish wish, bool cut);
    void makeScene(const Materials& materials);
    void makeSky();

    const Gpu& gpu_;
    const DebugNames& names_;
    const DrawTable& table_;
    std::array<SurfacePipelines, static_cast<std::size_t>(SurfaceKind::count)> gbuffer_{};
    // By fixed number of lights (0: any), whether all are directional, and Shading.
    std::array<VkPipeline, 20> shade_{};
    std::array<VkPipeline, 2> shade_compact_{};                      // by Shading
    std::vector<std::pair<std::string, SurfacePipelines>> shadowed_; // by the fragment shader
    bool blended_is_cut_ = false;                                    // somewhere
    std::vector<std::pair<ToneFacts, VkPipeline>> tone_;
    VkPipeline fxaa_ = VK_NULL_HANDLE;
    bool physical_only_ = false;
    std::vector<OwnedPipeline> all_;
};

} // namespace gnomon::host
