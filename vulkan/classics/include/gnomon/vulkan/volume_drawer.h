// SPDX-License-Identifier: Apache-2.0
// Draws shadow volumes for hosts with ordinary meshes: a ready-made DrawVolumes callback. The volumes are made on the
// GPU, from the positions at the time of drawing, so skinned and morphed meshes need nothing more.
// Based on: M. McGuire, J. F. Hughes, K. T. Egan, M. J. Kilgard, C. Everitt, "Fast, Practical and Robust Shadows",
// 2003.
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/caster_rows.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace gnomon::vulkan {

using pack::Rows3x4;

/// One light's shadow volumes to draw (pack::VolumeDraw), given to the host's callback. Rendering has begun, and the
/// camera's depth is in the depth buffer; viewport, scissor and, with FeatureUses::depth_bounds, depth bounds are set.
/// The callback binds its pipelines and draws; it must not end rendering. Its pipelines clamp depth, test it and do not
/// write it: GREATER with `reversed_z`, else LESS. Where the test fails they add 1 to the stencil for faces that turn
/// away from the eye and take 1 away for those that turn to it, wrapping. They write no colour.
struct VolumePass {
    VkCommandBuffer commands = VK_NULL_HANDLE;             // to record into
    VkFormat colour = VK_FORMAT_UNDEFINED;                 // format of the one colour attachment
    VkFormat depth_stencil = VK_FORMAT_D32_SFLOAT_S8_UINT; // format of that attachment; or D24_UNORM_S8_UINT
    bool reversed_z = true;                                // the camera's depth is 1 at the near plane
    const Plan* plan = nullptr;                            // never null
    std::uint32_t light = 0;                               // index into Plan::lights
    std::span<const std::uint32_t> casters;                // object indices: all of them must be drawn
    glm::mat4 clip_from_eye{1.0F};                         // the camera's, for points relative to the eye
    glm::dvec3 eye_ws{0.0};                                // metres, world space
    glm::vec4 place{0.0F}; // w = 0: xyz is the unit direction to the light; w = 1: its eye-relative position
};
/// Draws one light's volumes.
using DrawVolumes = std::function<void(const VolumePass&)>;

/// The volume of one object: a range of VolumeGeometry::elements. Without elements it casts nothing.
struct VolumeMesh {
    std::uint32_t first_element = 0; // index into VolumeGeometry::elements
    std::uint32_t element_count = 0; // 0 casts nothing
    std::uint32_t first_vertex = 0;  // index into positions; its elements and triangles count from there
};

/// Storage buffers that vertex shaders read while drawing. Positions may differ from slot to slot (skinned meshes).
/// Elements and triangles name one vertex for all vertices in one place; the positions of the others are not read.
struct VolumeGeometry {
    BufferRef positions; // three floats a vertex, packed
    /// Four 32-bit numbers each. An edge: the vertices that it leads from and to, as its left triangle runs along it,
    /// and the triangles on its left and right. The caps of a triangle: 0xFFFFFFFF, 0, the triangle, 0. Triangles count
    /// from the first of `triangles`; 0xFFFFFFFF on the right: there is none in this object.
    BufferRef elements;
    BufferRef triangles; // three 32-bit vertices each, counter-clockwise seen from outside
};

/// How a VolumeDrawer is made.
struct VolumeDrawerOptions {
    std::uint32_t frames_in_flight = 2;              // 1 .. kMostFrames
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
};

/// The effect of a wrong call, in every build:
///   a slot beyond frames_in_flight, frames_in_flight 0 or more than kMostFrames     Error
///   fewer transforms than objects, null buffers, or larger than a device binds      Error
///   draw() before beginFrame(), or of a null pass                                   Error
///   draw() after setScene(), or after a beginFrame() that threw                     Error, until beginFrame()
///   an object of the plan that setScene() was not given                             draws nothing
///
/// Not thread-safe. Needs the feature depthClamp. After a call that threw, beginFrame() again.
class GNOMON_API VolumeDrawer {
public:
    /// Throws Error when a function is missing or memory runs out.
    VolumeDrawer(const DeviceView& device, const VolumeDrawerOptions& options);
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~VolumeDrawer();
    VolumeDrawer(const VolumeDrawer&) = delete;
    VolumeDrawer& operator=(const VolumeDrawer&) = delete;

    /// Sets the volumes by object index of the plans. May allocate.
    void setScene(std::span<const VolumeMesh> objects);
    /// Before recordMask() of a frame with volumes. `world_from_object` is indexed by object index and read until the
    /// frame is recorded. Allocates nothing.
    void beginFrame(std::uint32_t slot, const VolumeGeometry& geometry, std::span<const Rows3x4> world_from_object);
    /// Draws one light's volumes; to be called from the DrawVolumes callback. Makes its pipeline the first time that it
    /// draws in such formats. Returns the number of draws, for Profiler::addDraws.
    std::uint32_t draw(const VolumePass& pass);

    [[nodiscard]] std::uint64_t triangles() const; // submitted since beginFrame(), degenerate ones included

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
