// SPDX-License-Identifier: Apache-2.0
// The draws of a scene in a frame: objects as instanced indirect draws grouped by material.
#pragma once

#include "draw_table.h"
#include "pipelines.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace gnomon::host {

class SceneDraws {
public:
    SceneDraws(Memory& memory, const DrawTable& table, const Geometry& geometry, const Materials& materials,
               std::uint32_t slots);

    /// Takes the new places of the dynamic objects, and tells `objects` which of them changed; `deformed`: those that
    /// deform have changed.
    void update(const scene::State& state, ObjectSet& objects, bool deformed);
    /// Writes instances and commands for the objects that the camera sees, for the frame that is recorded next. The GPU
    /// has finished the last frame of this slot.
    void build(std::uint32_t slot, const scene::State& state, const glm::dvec3& eye_ws,
               std::span<const std::uint32_t> visible);

    /// Inside rendering. Return the number of draw calls. recordOpaque binds the frame's set, the set of the maps, if
    /// any, and the vertex streams; for the others they must be bound. recordBlended draws with `blended`.
    std::uint32_t recordOpaque(VkCommandBuffer commands, const Pipelines& pipelines, const KindPipelines& of_kinds,
                               VkDescriptorSet frame_set, VkDescriptorSet maps_set = VK_NULL_HANDLE) const;
    std::uint32_t recordEmissive(VkCommandBuffer commands, const Pipelines& pipelines) const;
    /// Records the surfaces that fade into the sky, with this pipeline, after they are shaded.
    std::uint32_t recordFading(VkCommandBuffer commands, const Pipelines& pipelines, VkPipeline fading) const;
    std::uint32_t recordBlended(VkCommandBuffer commands, const Pipelines& pipelines,
                                const SurfacePipelines& blended) const;
    [[nodiscard]] bool anyBlended() const { return !blended_.empty(); } // in what was built last
    void bindStreams(VkCommandBuffer commands) const;

    [[nodiscard]] std::span<const vulkan::Rows3x4> transforms() const { return transforms_; }

private:
    struct Blended {
        std::uint32_t object = 0;
        double distance = 0.0; // from its middle to the eye, metres
        std::uint32_t instance = 0;
    };
    struct Slot {
        Buffer instances;
        Buffer commands;
    };
    void sortBlended(const scene::State& state, const glm::dvec3& eye_ws);
    void writeInstance(InstanceData& out, std::uint32_t object, bool receives, const glm::dvec3& eye_ws) const;
    std::uint32_t recordBatch(VkCommandBuffer commands, const Pipelines& pipelines,
                              const vulkan::BatchDraws& some) const;
    /// Binds what a batch's draws need besides the pipeline.
    void setBatch(VkCommandBuffer commands, const Pipelines& pipelines, const Batch& batch) const;

    bool indirect_; // FeatureUses::indirect_draws is on
    const DrawTable& table_;
    const Geometry& geometry_;
    const Materials& materials_;
    std::vector<vulkan::Rows3x4> transforms_; // absolute, per object
    vulkan::DrawBatcher batcher_;
    std::vector<Slot> slots_;
    const Slot* now_ = nullptr; // the slot of the last build()
    std::vector<std::uint32_t> handles_;
    vulkan::DrawLists lists_;
    std::vector<Blended> blended_; // blended draws of this frame, farthest first
};

} // namespace gnomon::host
