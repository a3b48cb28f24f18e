// SPDX-License-Identifier: Apache-2.0
// What to draw of a scene: objects as instanced indirect draws grouped by material, for the camera and for casters.
#pragma once

#include "geometry.h"
#include "pipelines.h"

#include <gnomon/vulkan/caster_drawer.h>

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace gnomon::host {

class SceneDraws {
public:
    SceneDraws(Memory& memory, const Geometry& geometry, const Materials& materials, const scene::Scene& scene,
               const scene::State& state);

    /// Takes over where the dynamic objects are now, and tells `objects` which of them changed; `deformed`: the
    /// deformed ones have.
    void update(const scene::State& state, ObjectSet& objects, bool deformed);
    /// Writes instances and commands for the objects that the camera sees.
    void build(const scene::State& state, const glm::dvec3& eye_ws, std::span<const std::uint32_t> visible);

    /// Inside rendering. Return the number of draw calls. recordOpaque binds the frame's set and the vertex streams
    /// itself; before the others they are bound.
    std::uint32_t recordOpaque(VkCommandBuffer commands, const Pipelines& pipelines, VkDescriptorSet frame_set) const;
    std::uint32_t recordEmissive(VkCommandBuffer commands, const Pipelines& pipelines) const;
    std::uint32_t recordBlended(VkCommandBuffer commands, const Pipelines& pipelines) const;
    void bindStreams(VkCommandBuffer commands) const;

    /// Once, after construction.
    void fillCasters(vulkan::CasterDrawer& drawer) const;
    [[nodiscard]] vulkan::CasterGeometry casterGeometry() const;
    [[nodiscard]] std::span<const vulkan::Rows3x4> transforms() const { return transforms_; }

private:
    struct Batch {
        SurfaceKind kind = SurfaceKind::plain;
        bool two_sided = false;
        bool mirrored = false;
        std::uint32_t material = 0;
        auto operator<=>(const Batch&) const = default;
    };
    struct Blended {
        std::uint32_t object = 0;
        double distance = 0.0; // of its middle from the eye, metres
        std::uint32_t instance = 0;
    };
    void collect(const scene::State& state);
    void writeInstance(InstanceData& out, std::uint32_t object, bool receives, const glm::dvec3& eye_ws) const;
    std::uint32_t recordBatch(VkCommandBuffer commands, const Pipelines& pipelines,
                              const vulkan::BatchDraws& some) const;
    void setSides(VkCommandBuffer commands, const Batch& batch) const;

    const Geometry& geometry_;
    const Materials& materials_;
    const scene::Scene& scene_;
    std::vector<Batch> batches_;
    std::vector<vulkan::DrawPart> parts_;
    std::vector<vulkan::DrawPart> caster_parts_;
    std::vector<vulkan::CasterBatch> caster_batches_;
    std::vector<vulkan::DrawObject> objects_;
    std::vector<vulkan::DrawObject> caster_objects_;
    std::vector<bool> is_blended_;
    std::vector<vulkan::Rows3x4> transforms_; // absolute, per object
    vulkan::DrawBatcher batcher_;
    Buffer instances_;
    Buffer commands_;
    std::vector<std::uint32_t> handles_;
    vulkan::DrawLists lists_;
    std::vector<Blended> blended_; // of this frame, farthest first
};

} // namespace gnomon::host
