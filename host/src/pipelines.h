// SPDX-License-Identifier: Apache-2.0
// The graphics pipelines that draw a scene, shared by all renderers: each is made once, and only where it is needed.
#pragma once

#include "draw_table.h"

#include "host/frame_renderer.h"

#include <gnomon/pack/technique_constants.h>

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::host {

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat kLightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kPictureFormat = VK_FORMAT_R8G8B8A8_UNORM;
inline constexpr VkFormat kOcclusionFormat = VK_FORMAT_R32_UINT; // host/shaders/occlusion_texel.glsl
inline constexpr std::uint32_t kFrameBindings = 12;              // bindings of set 0: numbers, and images from 1 on
/// Formats of the images that shading reads (host/shaders/gbuffer_surface.glsl); MaskInputs::normal, object_id, smooth.
using GBufferFormats = std::array<VkFormat, 4>;
/// 16-bit snorm for normals and smooth surfaces where the device draws to it, which none has to; else 32-bit floats,
/// which all do. So a normal never has fewer bits than the automatic bias is best with.
[[nodiscard]] GBufferFormats gbufferFormats(const Gpu& gpu);

/// Which of them a frame needs besides the first two. They are attached without a gap, in their order.
struct GBufferShape {
    bool ids = false;
    bool smooth = false;

    [[nodiscard]] std::size_t count() const { return 2U + (ids ? 1U : 0U) + (smooth ? 1U : 0U); }
    /// Which of GBufferFormats attachment `i` is.
    [[nodiscard]] std::size_t image(std::size_t i) const { return i == 2 && !ids ? 3 : i; }
};

/// The bindings of gnomon/visibility.glsl and technique_constants.glsl: constants, maps, lights, views, layers of
/// depth, blocks, tints, objects, few views.
inline constexpr std::array<VkDescriptorType, 9> kMapsBindings{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};

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

/// Whether passes that shade or draw the sky write the finished picture at once, and how.
struct Toning {
    bool on = false;
    ToneCurve curve = ToneCurve::neutral;
    bool dither = false;

    bool operator==(const Toning&) const = default;
};

/// The work of the tone pass.
struct ToneFacts {
    ToneCurve curve = ToneCurve::neutral;
    bool dither = false;
    bool average_four = false;
    float bloom = 0.0F; // factor of the bloom's sum; 0: none
    float bloom_radius = 1.0F;

    bool operator==(const ToneFacts&) const = default;
};

/// For objects that nothing cuts, and for those that clip planes do; null where the scene has none.
struct SurfacePipelines {
    VkPipeline whole = VK_NULL_HANDLE;
    VkPipeline cut = VK_NULL_HANDLE;

    [[nodiscard]] VkPipeline of(const Batch& batch) const { return batch.cut != 0 ? cut : whole; }
};

/// By SurfaceKind; null where the scene has none of the kind.
using KindPipelines = std::array<SurfacePipelines, static_cast<std::size_t>(SurfaceKind::count)>;

struct SkyFacts {
    Toning toned;
    bool physical = false;
    bool night = false; // with a moon or stars

    bool operator==(const SkyFacts&) const = default;
};

/// The facts of a frame that a shading pipeline is made for.
struct ShadedBy {
    std::uint32_t fixed_lights = 0; // how many lights the frame has, at most kMostFixedLights; 0: any number
    bool all_directional = false;
    bool phong_2005 = false; // Reflection
    Toning toned;
    bool occluded = false; // deferred: with ambient occlusion

    bool operator==(const ShadedBy&) const = default;
};
inline constexpr std::size_t kMostFixedLights = 4;

/// The facts that a pipeline for surfaces that are shaded as they are drawn is made for.
struct ForwardFacts {
    ShadedBy by;
    std::string fragment = "forward.frag"; // with a filter's name: in the shadow of its maps
    pack::TechniqueConstants technique;
    bool tints = false;        // blended casters may tint the light
    bool layered = false;      // some view is ViewServes::layered
    bool orthographic = false; // all views are

    bool operator==(const ForwardFacts&) const = default;
};
/// The shader for maps of these options.
[[nodiscard]] std::string forwardFragment(const ResolvedOptions& options);

class Pipelines {
public:
    Pipelines(const Gpu& gpu, const DebugNames& names, const Materials& materials, const DrawTable& table);
    ~Pipelines() = default;
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;

    SurfacePipelines blended; // lit without shadow
    SurfacePipelines emissive;
    KindPipelines depth_alone; // for opaque surfaces
    VkPipeline sky = VK_NULL_HANDLE;

    /// Whether surfaces can read maps as they are drawn (hasForwardSamplers()). If not, blended surfaces are lit
    /// without shadow, and nothing else is shaded forward.
    [[nodiscard]] bool readsMaps() const { return static_cast<bool>(shadowed_layout); }

    // These compile at the first call, which must not be while a frame is recorded.
    /// Opaque surfaces to the images of this shape.
    [[nodiscard]] const KindPipelines& gbufferFor(const GBufferShape& shape);
    /// The shading pass. Phong and unlit surfaces are left out where the scene has none.
    [[nodiscard]] VkPipeline shadeFor(const ShadedBy& by);
    /// Blended surfaces in the shadow of maps of this filter. Precondition: the scene has some.
    [[nodiscard]] SurfacePipelines shadowedFor(const ResolvedOptions& options);
    /// The shading pass of a compact mask.
    [[nodiscard]] VkPipeline shadeCompact(const ShadedBy& by);
    /// Opaque surfaces, and the sky beside them.
    [[nodiscard]] const KindPipelines& forwardFor(const ForwardFacts& facts);
    [[nodiscard]] VkPipeline skyFor(const SkyFacts& facts);
    /// Is there a surface that fades into the sky?
    [[nodiscard]] bool fades() const { return fades_; }
    /// The sky over such surfaces, by how much they fade. Precondition: there are some, and the facts are not toned.
    [[nodiscard]] VkPipeline fadingFor(const SkyFacts& facts);
    [[nodiscard]] VkPipeline toneFor(const ToneFacts& facts);
    [[nodiscard]] VkPipeline fxaa();
    /// The passes of ambient occlusion.
    [[nodiscard]] VkPipeline occlusionSearch();
    [[nodiscard]] VkPipeline occlusionSmooth();

    const GBufferFormats gbuffer_formats;
    OwnedSetLayout frame_layout;
    OwnedPipelineLayout scene_layout;    // set 0 frame, set 1 material; pushed: scene::ClipPlanes of what is cut
    OwnedPipelineLayout screen_layout;   // set 0 frame
    OwnedSetLayout tiles_layout;         // for a compact mask: ShadowRenderer::maskTiles()
    OwnedPipelineLayout compact_layout;  // as screen_layout, and set 1 tiles
    OwnedSetLayout maps_layout;          // the bindings of gnomon/visibility.glsl
    OwnedPipelineLayout shadowed_layout; // as scene_layout, and set 2 maps; pushed as there. Or null

private:
    void makeLayouts(VkDescriptorSetLayout material);
    void makeCompactLayout();
    void makeShadowedLayout(VkDescriptorSetLayout material);
    [[nodiscard]] OwnedPipelineLayout makeLayout(std::span<const VkDescriptorSetLayout> sets,
                                                 bool of_scene = false) const;
    [[nodiscard]] OwnedShader module(std::string_view name) const;
    struct Wish;
    enum class Kind : std::uint8_t { none, whole, cut };
    static void setKind(Wish& wish, SurfaceKind kind);
    static void setToning(Wish& wish, const Toning& toned);
    void setLights(Wish& wish, const ShadedBy& by) const;
    VkPipeline makeShade(const ShadedBy& by, bool compact);
    void makeDepthAlone();
    [[nodiscard]] static Wish blendedWish();
    VkPipeline make(const Wish& wish);
    /// `cut`: some surfaces are cut.
    SurfacePipelines makeSurface(Wish wish, bool cut);
    void makeScene(const Materials& materials);
    [[nodiscard]] VkPipeline makeSky(const SkyFacts& facts, bool over_surface = false);
    [[nodiscard]] VkPipeline makeOcclusion(const char* name, std::string_view fragment);

    const Gpu& gpu_;
    const DebugNames& names_;
    const DrawTable& table_;
    std::array<Kind, static_cast<std::size_t>(SurfaceKind::count)> opaque_kinds_{}; // that the scene has
    std::deque<std::pair<ForwardFacts, KindPipelines>> forward_;                    // references to them stay
    std::array<std::optional<KindPipelines>, 4> gbuffer_;                           // by shape
    std::vector<std::pair<SkyFacts, VkPipeline>> sky_;
    std::vector<std::pair<SkyFacts, VkPipeline>> fading_;
    std::vector<std::pair<ShadedBy, VkPipeline>> shade_;
    std::vector<std::pair<ShadedBy, VkPipeline>> shade_compact_;
    struct Shadowed {
        std::string fragment;
        pack::TechniqueConstants technique;
        SurfacePipelines pipelines;
    };
    std::vector<Shadowed> shadowed_;
    bool blended_is_cut_ = false; // somewhere
    std::vector<std::pair<ToneFacts, VkPipeline>> tone_;
    VkPipeline fxaa_ = VK_NULL_HANDLE;
    VkPipeline occlusion_search_ = VK_NULL_HANDLE;
    VkPipeline occlusion_smooth_ = VK_NULL_HANDLE;
    bool physical_only_ = false;
    bool fades_ = false; // some surface into the sky
    std::vector<OwnedPipeline> all_;
};

} // namespace gnomon::host
