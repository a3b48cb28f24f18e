// SPDX-License-Identifier: Apache-2.0
// Draws casters for hosts with ordinary meshes: a ready-made DrawCasters callback. Hosts with vertex formats of their
// own write their callback and shaders instead (gnomon/caster.glsl).
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/caster_rows.h>
#include <gnomon/vulkan/draw_batcher.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::vulkan {

using pack::Rows3x4;

/// A plane that cuts nothing.
inline constexpr glm::vec4 kNoClipPlane{0.0F, 0.0F, 0.0F, 1.0F};

/// A batch of DrawParts, by DrawPart::batch.
struct CasterBatch {
    /// All its triangles cast, whichever way they face. False is for closed meshes alone:
    /// CasterDrawerOptions::cull_back_faces then leaves out triangles that face away from the light, and
    /// CasterFaces::back those that face it. CasterCull leaves triangles out in either case.
    bool two_sided = true;
    /// Alpha-masked: a set with one COMBINED_IMAGE_SAMPLER at binding 0, FRAGMENT stage, whose alpha is tested;
    /// VK_NULL_HANDLE: opaque.
    VkDescriptorSet texture = VK_NULL_HANDLE;
    float cutoff = 0.5F;          // 0 or above; kept where alpha >= alphaLimit(cutoff) (gnomon/shared/alpha_cutoff.h);
                                  // divide by the material's own alpha factor
    glm::vec2 uv_scale{1.0F};     // KHR_texture_transform
    glm::vec2 uv_offset{0.0F};    // KHR_texture_transform
    float uv_rotation_rad = 0.0F; // KHR_texture_transform: scaled, then rotated, then moved
    /// Blended: it lets 1 - alpha of the light through, and it is drawn to maps of tints alone. `texture` is its
    /// colour, linear when sampled, and must be given: a white texel where the material has none. `tint` multiplies it.
    bool blended = false;
    glm::vec4 tint{1.0F}; // linear colour and alpha; blended batches alone
    /// CasterVertices::colour multiplies `texture` and `tint`. In a masked batch only its alpha counts; in a batch
    /// without a texture it is not read.
    bool vertex_colours = false;
    /// For blended batches: stained glass, which lets 1 - alpha (1 - colour) through (gnomon/shared/blended_tint.h).
    bool stained = false;
    /// Planes that cut its objects, in the space of their vertices, before world_from_object: a point is not drawn
    /// where dot(plane.xyz, p) + plane.w < 0 for either plane. Finite; the default planes cut nothing. A mesh that is
    /// cut is open, so all its triangles cast, whatever `two_sided` says. Bounds in the ObjectSet may be those of the
    /// remaining part. Any other plane than the default needs the device feature shaderClipDistance
    /// (FeatureUses::clip_planes).
    std::array<glm::vec4, 2> clip_planes{kNoClipPlane, kNoClipPlane};
    /// The transforms of its objects turn left into right (their determinants are negative), so that its triangles wind
    /// the other way. It has no effect where no triangles are left out.
    bool mirrored = false;
};

/// One attribute of the host's vertices.
struct VertexAttribute {
    VkFormat format = VK_FORMAT_UNDEFINED; // UNDEFINED: there is none
    std::uint32_t stride = 0;              // bytes from one vertex to the next
    std::uint32_t offset = 0;              // bytes from a vertex's first
};

/// How the host's vertices and indices are stored. Interleaved vertices have all attributes in one buffer.
struct CasterVertices {
    /// R32G32B32_SFLOAT, R32G32B32A32_SFLOAT, R16G16B16A16_SFLOAT, R16G16B16A16_SNORM or R16G16B16A16_UNORM; a fourth
    /// number is not read. For normalised formats, world_from_object gives the object's size.
    VertexAttribute position{VK_FORMAT_R32G32B32_SFLOAT, 12, 0};
    /// R32G32_SFLOAT, R16G16_SFLOAT or R16G16_UNORM. UNDEFINED: there are none. Read only for batches with a texture.
    VertexAttribute uv{VK_FORMAT_R32G32_SFLOAT, 8, 0};
    /// R8G8B8A8_UNORM, R16G16B16A16_UNORM, R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT: linear colour and alpha, 0 .. 1.
    /// UNDEFINED: there are none. Read only for batches with CasterBatch::vertex_colours.
    VertexAttribute colour;
    /// R16_UINT or R32_UINT: the piece of its object that a vertex belongs to, in the lower 12 bits; the three vertices
    /// of a triangle have the same piece. Only for lights with IdOf::face. UNDEFINED: there are none.
    VertexAttribute piece;
    VkIndexType index = VK_INDEX_TYPE_UINT32; // or UINT16
};

/// Buffers that are read while drawing, as CasterDrawerOptions::vertices says. They may differ from slot to slot
/// (skinned meshes).
struct CasterGeometry {
    VkBuffer positions = VK_NULL_HANDLE; // CasterVertices::position
    VkDeviceSize positions_offset = 0;   // bytes
    VkBuffer uvs = VK_NULL_HANDLE;       // may be null when no batch has a texture
    VkDeviceSize uvs_offset = 0;         // bytes
    VkBuffer indices = VK_NULL_HANDLE;   // CasterVertices::index
    VkDeviceSize indices_offset = 0;     // bytes
    VkBuffer pieces = VK_NULL_HANDLE;    // CasterVertices::piece
    VkDeviceSize pieces_offset = 0;      // bytes
    VkBuffer colours = VK_NULL_HANDLE;   // CasterVertices::colour; may be null when no batch has vertex colours
    VkDeviceSize colours_offset = 0;     // bytes
};

/// How a CasterDrawer is made.
struct CasterDrawerOptions {
    std::uint32_t frames_in_flight = 2; // 1 .. kMostFrames
    /// Leave out triangles that face away from the light, in batches that are not two-sided. Ignored with
    /// CasterFaces::back. Off by default, because thin and open geometry casts too.
    bool cull_back_faces = false;
    /// The front of a triangle is the side from which it is seen clockwise, with the frame's numbers read as a
    /// right-handed world. A host with a left-handed world calls these triangles counter-clockwise.
    bool clockwise_front = false;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
    CasterVertices vertices;                         // the layout of the host's buffers
};

/// The effect of a wrong call, in every build:
///   a part that names no batch, an object that names no part                        Error
///   a clip plane that is not finite                                                 Error
///   a batch with a texture without CasterVertices::uv or CasterGeometry::uvs        Error
///   one with vertex colours without CasterVertices::colour or CasterGeometry::colours Error
///   a slot beyond frames_in_flight, frames_in_flight 0 or more than kMostFrames     Error
///   a plan whose numbers point beyond its own lists or pages                        Error
///   a plan with IdOf::face without CasterVertices::piece or CasterGeometry::pieces Error
///   fewer transforms than the scene has objects, null positions or indices          Error
///   draw() before beginFrame(), of a null pass, or of more than that plan's lists   Error
///   an object of the plan that setScene() was not given                             draws nothing
/// Not checked, because only the driver knows: buffers that are smaller than the scene's ranges.
///
/// Not thread-safe. Needs the features drawIndirectFirstInstance and multiDrawIndirect.
///
/// After a call that threw (Error, std::bad_alloc) the scene is that of the last setScene() that did not throw, and the
/// next beginFrame() makes whatever is missing. After ErrorKind::device_lost only the destructor may be called; it
/// neither waits nor throws.
class GNOMON_API CasterDrawer {
public:
    /// Throws Error when a function is missing, a format of the vertices is none of those above or memory runs out.
    explicit CasterDrawer(const DeviceView& device, const CasterDrawerOptions& options = {});
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~CasterDrawer();
    CasterDrawer(const CasterDrawer&) = delete;
    CasterDrawer& operator=(const CasterDrawer&) = delete;

    /// Sets the geometry that each object index of the plans draws. May allocate. `batches` is indexed by
    /// DrawPart::batch.
    void setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects,
                  std::span<const CasterBatch> batches);
    /// Sets a scene in which all is opaque: the parts' batch is 0.
    void setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects);

    /// Sets biases of single casters, for exceptional ones: maps hold such a caster this many metres (DepthMetric's)
    /// farther from the light than it is, or nearer where negative. By object index; 0 beyond the end and before the
    /// first call. They apply to all later drawing: call ObjectSet::touch() for objects whose bias changed, so that
    /// kept maps are drawn anew. May allocate. Throws Error where one is not finite.
    void setBiases(std::span<const float> bias_m);

    /// Makes the pipelines for maps by these options, so that no beginFrame() has to: for the batches of setScene().
    /// `perspective`: there may be spots, or warps.
    void warmUp(const ResolvedOptions& options, bool perspective);
    /// Before recordMaps() of a frame. Makes the pipelines that the plan needs and that are missing.
    /// `world_from_object` is indexed by object index and read until the frame is recorded, then no more. Grows the
    /// slot's buffers when the plan's lists are longer than any before; else allocates nothing. Throws Error when
    /// memory runs out.
    void beginFrame(std::uint32_t slot, const Plan& plan, const CasterGeometry& geometry,
                    std::span<const Rows3x4> world_from_object);
    /// For recordMaps(): draws each pass. Valid as long as the drawer lives.
    [[nodiscard]] DrawCasters callback();
    /// Draws one pass; to be called from a DrawCasters callback of the host's own. Passes of several views between two
    /// beginFrame() must come from one ShadowRenderer. Returns the number of indirect draws it recorded, for
    /// Profiler::addDraws.
    std::uint32_t draw(const MapPass& pass);

    [[nodiscard]] std::uint64_t triangles() const; // submitted since beginFrame()
    /// The layout that CasterBatch::texture sets must be compatible with. A host's own layout with the same definition
    /// serves as well.
    [[nodiscard]] VkDescriptorSetLayout textureSetLayout() const;
    /// Its allocated memory, by purpose; valid until it allocates again.
    [[nodiscard]] std::span<const MemoryUse> memory() const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
