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
    /// All its triangles cast, whichever way they face. False, for closed meshes alone, where it matters that some are
    /// left out: with CasterDrawerOptions::cull_back_faces those that face away from the light, with CasterFaces::back
    /// those that face it. CasterCull leaves triangles out all the same.
    bool two_sided = true;
    /// Alpha-masked: a set with one COMBINED_IMAGE_SAMPLER at binding 0, FRAGMENT stage, whose alpha is tested;
    /// VK_NULL_HANDLE: opaque.
    VkDescriptorSet texture = VK_NULL_HANDLE;
    float cutoff = 0.5F;          // 0 or above; kept where alpha >= alphaLimit(cutoff) (gnomon/shared/alpha_cutoff.h);
                                  // divide by the material's own alpha factor
    glm::vec2 uv_scale{1.0F};     // KHR_texture_transform
    glm::vec2 uv_offset{0.0F};    // likewise
    float uv_rotation_rad = 0.0F; // as KHR_texture_transform has it: scaled, then rotated, then moved
    /// Blended: 1 - alpha of the light goes on behind it, and it is drawn to maps of tints alone. `texture` is its
    /// colour, linear when sampled, and must be there: a white texel where the material has none. `tint` multiplies it.
    bool blended = false;
    glm::vec4 tint{1.0F}; // linear colour and alpha; blended batches alone
    /// CasterVertices::colour multiplies `texture` and `tint`. In a masked batch its alpha alone counts, and
    /// nothing in one without a texture.
    bool vertex_colours = false;
    /// For blended batches: stained glass, behind which 1 - alpha (1 - colour) goes on (gnomon/shared/blended_tint.h).
    bool stained = false;
    /// What cuts its objects, in the space of their vertices, before world_from_object: a point is not drawn where
    /// dot(plane.xyz, p) + plane.w < 0 for either plane. Finite; those here by default cut nothing. A mesh that is cut
    /// is open, so all its triangles cast, whatever `two_sided` says. Bounds in the ObjectSet may be those of what is
    /// left. With others the device must have the feature shaderClipDistance on (FeatureUses::clip_planes).
    std::array<glm::vec4, 2> clip_planes{kNoClipPlane, kNoClipPlane};
    /// The transforms of its objects turn left into right (their determinants are negative), so that its triangles wind
    /// the other way. Of no effect where none are left out.
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
    /// number is not read. Of normalised ones, world_from_object says how large an object is.
    VertexAttribute position{VK_FORMAT_R32G32B32_SFLOAT, 12, 0};
    /// R32G32_SFLOAT, R16G16_SFLOAT or R16G16_UNORM. UNDEFINED: there are none. Read for batches with a
    /// texture alone.
    VertexAttribute uv{VK_FORMAT_R32G32_SFLOAT, 8, 0};
    /// R8G8B8A8_UNORM, R16G16B16A16_UNORM, R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT: linear colour and alpha, 0 .. 1.
    /// UNDEFINED: there are none. Read for batches with CasterBatch::vertex_colours alone.
    VertexAttribute colour;
    /// R16_UINT or R32_UINT: which piece of its object a vertex is of, in the lower 12 bits; the three of a triangle
    /// have one. For lights with IdOf::face alone. UNDEFINED: vertices do not say so.
    VertexAttribute piece;
    VkIndexType index = VK_INDEX_TYPE_UINT32; // or UINT16
};

/// Buffers that are read while drawing, as CasterDrawerOptions::vertices says. They may differ from slot to slot
/// (skinned meshes).
struct CasterGeometry {
    VkBuffer positions = VK_NULL_HANDLE; // of CasterVertices::position
    VkDeviceSize positions_offset = 0;   // bytes
    VkBuffer uvs = VK_NULL_HANDLE;       // may be null when no batch has a texture
    VkDeviceSize uvs_offset = 0;         // bytes
    VkBuffer indices = VK_NULL_HANDLE;   // of CasterVertices::index
    VkDeviceSize indices_offset = 0;     // bytes
    VkBuffer pieces = VK_NULL_HANDLE;    // of CasterVertices::piece
    VkDeviceSize pieces_offset = 0;      // bytes
    VkBuffer colours = VK_NULL_HANDLE;   // of CasterVertices::colour; may be null when no batch has vertex colours
    VkDeviceSize colours_offset = 0;     // bytes
};

/// How a CasterDrawer is made.
struct CasterDrawerOptions {
    std::uint32_t frames_in_flight = 2; // 1 .. kMostFrames
    /// Leave out triangles that face away from the light (of batches that are not two-sided), but with
    /// CasterFaces::back. Off, because thin and open geometry casts too.
    bool cull_back_faces = false;
    /// The triangles that face front are clockwise as seen from there, in world space as the frame's numbers are read:
    /// right-handed. Of a host whose world is left-handed these are the ones that it calls counter-clockwise.
    bool clockwise_front = false;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
    CasterVertices vertices;                         // what its buffers hold
};

/// What becomes of a wrong call, in every build:
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
/// Not found out, because only the driver knows: buffers that are smaller than the scene's ranges say.
///
/// Not thread-safe. Needs the features drawIndirectFirstInstance and multiDrawIndirect.
///
/// After a call that threw (Error, std::bad_alloc) the scene is what the last setScene() that did not throw says, and
/// the next beginFrame() makes what is not there. After ErrorKind::device_lost only the destructor is of use: it
/// neither waits nor throws.
class GNOMON_API CasterDrawer {
public:
    /// Throws Error when a function is missing, a format of the vertices is none of those above or memory runs out.
    explicit CasterDrawer(const DeviceView& device, const CasterDrawerOptions& options = {});
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~CasterDrawer();
    CasterDrawer(const CasterDrawer&) = delete;
    CasterDrawer& operator=(const CasterDrawer&) = delete;

    /// What the object indices of the plans draw. May allocate. `batches` is indexed by DrawPart::batch.
    void setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects,
                  std::span<const CasterBatch> batches);
    /// All is opaque: the parts' batch is 0.
    void setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects);

    /// Biases of single casters, for the one that nothing else serves: in maps they are so many metres (DepthMetric's)
    /// farther from the light than they are, or nearer. By object index; beyond the end 0, and so is all before the
    /// first call. What is drawn from now on has them: ObjectSet::touch() those that changed, and maps that are kept
    /// are drawn anew. May allocate. Throws Error where one is not finite.
    void setBiases(std::span<const float> bias_m);

    /// Makes the pipelines for maps by these options, so that no beginFrame() has to: for the batches of setScene().
    /// `perspective`: there may be spots, or warps.
    void warmUp(const ResolvedOptions& options, bool perspective);
    /// Before recordMaps() of a frame. Makes what pipelines the plan needs and are not there. `world_from_object` is
    /// indexed by object index and read until the frame is recorded, then no more. Grows the slot's buffers when the
    /// plan's lists are longer than any before; else allocates nothing. Throws Error when memory runs out.
    void beginFrame(std::uint32_t slot, const Plan& plan, const CasterGeometry& geometry,
                    std::span<const Rows3x4> world_from_object);
    /// For recordMaps(): draws each pass. Of use for as long as the drawer lives.
    [[nodiscard]] DrawCasters callback();
    /// Draws one pass; to be called from a DrawCasters callback of the host's own. Those of several views between two
    /// beginFrame() must come from one ShadowRenderer. Returns the number of indirect draws it recorded, for
    /// Profiler::addDraws.
    std::uint32_t draw(const MapPass& pass);

    [[nodiscard]] std::uint64_t triangles() const; // submitted since beginFrame()
    /// The layout that CasterBatch::texture sets must be compatible with. A layout of the host's own that is defined
    /// alike serves as well.
    [[nodiscard]] VkDescriptorSetLayout textureSetLayout() const;
    /// What it has allocated, by purpose; valid until it allocates again.
    [[nodiscard]] std::span<const MemoryUse> memory() const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
