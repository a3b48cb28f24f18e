// SPDX-License-Identifier: Apache-2.0
#include "scene_draws.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstring>

namespace gnomon::host {
namespace {

bool same(const vulkan::Rows3x4& a, const vulkan::Rows3x4& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Binds `pipeline` unless it is `bound` already.
void bind(VkCommandBuffer commands, VkPipeline pipeline, VkPipeline& bound)
{
    if (pipeline != bound) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        bound = pipeline;
    }
}

} // namespace

SceneDraws::SceneDraws(Memory& memory, const DrawTable& table, const Geometry& geometry, const Materials& materials,
                       std::uint32_t slots)
    : indirect_(memory.gpu().view().features.indirect_draws), table_(table), geometry_(geometry), materials_(materials),
      transforms_(table.transforms), slots_(slots)
{
    batcher_.setScene(table.parts, table.objects);
    const std::size_t count = table.objects.size();
    for (Slot& slot : slots_) {
        slot.instances = memory.buffer("host instances", count * sizeof(InstanceData),
                                       VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Place::host);
        slot.commands = memory.buffer("host draw commands", table.parts.size() * sizeof(VkDrawIndexedIndirectCommand),
                                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, Place::host);
    }
    handles_.resize(count);
    blended_.reserve(count);
}

void SceneDraws::update(const scene::State& state, ObjectSet& objects, bool deformed)
{
    for (std::uint32_t i = 0; i < state.objects.size(); ++i) {
        const scene::Object& object = state.objects[i];
        if (!object.dynamic) {
            continue;
        }
        const vulkan::Rows3x4 now = rowsOf(object.world_from_object);
        const std::uint64_t before = objects.version();
        const ObjectId id = objects.idAt(i);
        (void)objects.update(id, object.bounds_ws);
        const bool moved = !same(now, transforms_[i]);
        if ((moved || (deformed && object.deformed != scene::kNone)) && objects.version() == before) {
            (void)objects.touch(id);
        }
        transforms_[i] = now;
    }
}

void SceneDraws::writeInstance(InstanceData& out, std::uint32_t object, bool receives, const glm::dvec3& eye_ws) const
{
    InstanceData data;
    data.row_x = transforms_[object].x;
    data.row_y = transforms_[object].y;
    data.row_z = transforms_[object].z;
    data.row_x.w = static_cast<float>(double{data.row_x.w} - eye_ws.x);
    data.row_y.w = static_cast<float>(double{data.row_y.w} - eye_ws.y);
    data.row_z.w = static_cast<float>(double{data.row_z.w} - eye_ws.z);
    data.id = object + 1;
    data.receiver_id = receives ? object + 1 : 0;
    data.tints = table_.blended[object];
    std::memcpy(static_cast<void*>(&out), &data, sizeof data); // whole, in order: the memory may be write-combined
}

void SceneDraws::build(std::uint32_t slot, const scene::State& state, const glm::dvec3& eye_ws,
                       std::span<const std::uint32_t> visible)
{
    now_ = &slots_[slot];
    auto* const instances = static_cast<InstanceData*>(now_->instances.mapped);
    auto* const commands = static_cast<VkDrawIndexedIndirectCommand*>(now_->commands.mapped);
    lists_ = batcher_.build(visible, 0, {commands, table_.parts.size()}, handles_);
    for (std::uint32_t i = 0; i < lists_.instance_count; ++i) {
        writeInstance(instances[i], handles_[i], state.objects[handles_[i]].receives, eye_ws);
    }
    sortBlended(state, eye_ws);
}

void SceneDraws::sortBlended(const scene::State& state, const glm::dvec3& eye_ws)
{
    const auto* const commands = static_cast<const VkDrawIndexedIndirectCommand*>(now_->commands.mapped);
    blended_.clear();
    for (const vulkan::BatchDraws& draws : lists_.batches) {
        if (!materials_.all()[table_.batches[draws.batch].material].blended) {
            continue;
        }
        for (std::uint32_t c = draws.first_command; c < draws.first_command + draws.command_count; ++c) {
            for (std::uint32_t i = 0; i < commands[c].instanceCount; ++i) {
                const std::uint32_t instance = commands[c].firstInstance + i;
                const glm::dvec3 centre(state.objects[handles_[instance]].bounds_ws.centre());
                blended_.push_back({handles_[instance], glm::length(centre - eye_ws), instance});
            }
        }
    }
    std::sort(blended_.begin(), blended_.end(), [](const Blended& a, const Blended& b) {
        return a.distance != b.distance ? a.distance > b.distance : a.object < b.object;
    });
}

void SceneDraws::bindStreams(VkCommandBuffer commands) const
{
    const std::array<VkBuffer, 4> buffers{geometry_.positions.handle, geometry_.uvs.handle, geometry_.attributes.handle,
                                          now_->instances.handle};
    const std::array<VkDeviceSize, 4> offsets{};
    vkCmdBindVertexBuffers(commands, 0, buffers.size(), buffers.data(), offsets.data());
    vkCmdBindIndexBuffer(commands, geometry_.indices.handle, 0, VK_INDEX_TYPE_UINT32);
}

void SceneDraws::setBatch(VkCommandBuffer commands, const Pipelines& pipelines, const Batch& batch) const
{
    VkPipelineLayout layout = pipelines.scene_layout.get();
    vkCmdSetCullMode(commands, batch.two_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
    vkCmdSetFrontFace(commands, batch.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1,
                            &materials_.all()[batch.material].set, 0, nullptr);
    if (batch.cut != 0) {
        vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(scene::ClipPlanes),
                           &table_.cuts[batch.cut]);
    }
}

std::uint32_t SceneDraws::recordBatch(VkCommandBuffer commands, const Pipelines& pipelines,
                                      const vulkan::BatchDraws& some) const
{
    setBatch(commands, pipelines, table_.batches[some.batch]);
    if (indirect_) {
        vkCmdDrawIndexedIndirect(commands, now_->commands.handle,
                                 some.first_command * sizeof(VkDrawIndexedIndirectCommand), some.command_count,
                                 sizeof(VkDrawIndexedIndirectCommand));
        return some.command_count;
    }
    const auto* const all = static_cast<const VkDrawIndexedIndirectCommand*>(now_->commands.mapped);
    for (const VkDrawIndexedIndirectCommand& one : std::span(all + some.first_command, some.command_count)) {
        vkCmdDrawIndexed(commands, one.indexCount, one.instanceCount, one.firstIndex, one.vertexOffset,
                         one.firstInstance);
    }
    return some.command_count;
}

std::uint32_t SceneDraws::recordOpaque(VkCommandBuffer commands, const Pipelines& pipelines,
                                       const KindPipelines& of_kinds, VkDescriptorSet frame_set,
                                       VkDescriptorSet maps_set) const
{
    std::uint32_t draws = 0;
    VkPipeline bound = VK_NULL_HANDLE;
    for (const vulkan::BatchDraws& some : lists_.batches) {
        const Batch& batch = table_.batches[some.batch];
        const MaterialFacts& facts = materials_.all()[batch.material];
        if (facts.blended) {
            continue;
        }
        const bool first = bound == VK_NULL_HANDLE;
        bind(commands, of_kinds[static_cast<std::size_t>(batch.kind)].of(batch), bound);
        if (first) { // not before the pipeline [drivers: set-first]
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout.get(), 0, 1,
                                    &frame_set, 0, nullptr);
            if (maps_set != VK_NULL_HANDLE) {
                vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.shadowed_layout.get(), 2,
                                        1, &maps_set, 0, nullptr);
            }
            bindStreams(commands);
        }
        draws += recordBatch(commands, pipelines, some);
    }
    return draws;
}

std::uint32_t SceneDraws::recordEmissive(VkCommandBuffer commands, const Pipelines& pipelines) const
{
    std::uint32_t draws = 0;
    VkPipeline bound = VK_NULL_HANDLE;
    for (const vulkan::BatchDraws& some : lists_.batches) {
        const Batch& batch = table_.batches[some.batch];
        const MaterialFacts& facts = materials_.all()[batch.material];
        if (facts.blended || !facts.emits) {
            continue;
        }
        bind(commands, pipelines.emissive.of(batch), bound);
        draws += recordBatch(commands, pipelines, some);
    }
    return draws;
}

std::uint32_t SceneDraws::recordFading(VkCommandBuffer commands, const Pipelines& pipelines, VkPipeline fading) const
{
    std::uint32_t draws = 0;
    VkPipeline bound = VK_NULL_HANDLE;
    for (const vulkan::BatchDraws& some : lists_.batches) {
        if (materials_.all()[table_.batches[some.batch].material].fades) {
            bind(commands, fading, bound);
            draws += recordBatch(commands, pipelines, some);
        }
    }
    return draws;
}

std::uint32_t SceneDraws::recordBlended(VkCommandBuffer commands, const Pipelines& pipelines,
                                        const SurfacePipelines& blended) const
{
    VkPipeline bound = VK_NULL_HANDLE;
    for (const Blended& one : blended_) {
        const vulkan::DrawPart& part = table_.parts[table_.objects[one.object].first_part];
        const Batch& batch = table_.batches[part.batch];
        bind(commands, blended.of(batch), bound);
        setBatch(commands, pipelines, batch);
        vkCmdDrawIndexed(commands, part.mesh.index_count, 1, part.mesh.first_index, part.mesh.vertex_offset,
                         one.instance);
    }
    return static_cast<std::uint32_t>(blended_.size());
}

} // namespace gnomon::host
