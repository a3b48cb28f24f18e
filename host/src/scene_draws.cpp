// SPDX-License-Identifier: Apache-2.0
#include "scene_draws.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>

namespace gnomon::host {
namespace {

vulkan::Rows3x4 rowsOf(const glm::mat4& m)
{
    return {glm::vec4{m[0].x, m[1].x, m[2].x, m[3].x}, glm::vec4{m[0].y, m[1].y, m[2].y, m[3].y},
            glm::vec4{m[0].z, m[1].z, m[2].z, m[3].z}};
}

bool same(const vulkan::Rows3x4& a, const vulkan::Rows3x4& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

} // namespace

SceneDraws::SceneDraws(Memory& memory, const Geometry& geometry, const Materials& materials, const scene::Scene& scene,
                       const scene::State& state)
    : geometry_(geometry), materials_(materials), scene_(scene)
{
    collect(state);
    batcher_.setScene(parts_, objects_);
    const std::size_t count = state.objects.size();
    instances_ =
        memory.buffer("host instances", count * sizeof(InstanceData), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Place::host);
    commands_ = memory.buffer("host draw commands", parts_.size() * sizeof(VkDrawIndexedIndirectCommand),
                              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, Place::host);
    handles_.resize(count);
    blended_.reserve(count);
}

void SceneDraws::collect(const scene::State& state)
{
    using Key = std::tuple<Batch, std::uint32_t, std::uint32_t, std::uint32_t>; // batch, mesh, primitive, deformed
    std::map<Batch, std::uint32_t> batch_ids;
    std::vector<Key> keys;
    keys.reserve(state.objects.size());
    for (const scene::Object& object : state.objects) {
        const std::uint32_t material = materials_.indexOf(object.material);
        const MaterialFacts& facts = materials_.all()[material];
        const bool mirrored = glm::determinant(glm::mat3(object.world_from_object)) < 0.0F;
        const Batch batch{facts.kind, facts.two_sided, mirrored, material};
        batch_ids.emplace(batch, 0);
        keys.emplace_back(batch, object.mesh, object.primitive, object.deformed);
    }
    // Casters: one batch for everything opaque, one for each masked material.
    std::vector<std::uint32_t> caster_ids(materials_.all().size(), 0);
    caster_batches_.emplace_back();
    for (std::uint32_t i = 0; i < materials_.all().size(); ++i) {
        if (materials_.all()[i].caster_set != VK_NULL_HANDLE) {
            const scene::Material& material = scene_.materials[i];
            const scene::TextureUse& use = material.base_colour_texture;
            caster_ids[i] = static_cast<std::uint32_t>(caster_batches_.size());
            const float cutoff = material.alpha_cutoff / std::max(material.base_colour.a, 1e-6F);
            caster_batches_.push_back(
                {true, materials_.all()[i].caster_set, cutoff, use.scale, use.offset, use.rotation_rad});
        }
    }
    for (auto& [batch, id] : batch_ids) {
        id = static_cast<std::uint32_t>(batches_.size());
        batches_.push_back(batch);
    }
    std::map<Key, std::uint32_t> part_ids;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const Batch& batch = std::get<0>(keys[i]);
        const auto [part, fresh] = part_ids.emplace(keys[i], static_cast<std::uint32_t>(parts_.size()));
        if (fresh) {
            const vulkan::MeshRange range = geometry_.range(state.objects[i]);
            parts_.push_back({range, batch_ids[batch]});
            caster_parts_.push_back({range, caster_ids[batch.material]});
        }
        const bool blended = materials_.all()[batch.material].blended;
        is_blended_.push_back(blended);
        objects_.push_back({part->second, 1U});
        // What is blended lets light through; as a map holds all or nothing, it casts nothing.
        caster_objects_.push_back({part->second, blended ? 0U : 1U});
        transforms_.push_back(rowsOf(state.objects[i].world_from_object));
    }
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
        objects.update(i, object.bounds_ws);
        const bool moved = !same(now, transforms_[i]);
        if ((moved || (deformed && object.deformed != scene::kNone)) && objects.version() == before) {
            objects.touch(i);
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
    std::memcpy(static_cast<void*>(&out), &data, sizeof data); // whole, in order: the memory may be write-combined
}

void SceneDraws::build(const scene::State& state, const glm::dvec3& eye_ws, std::span<const std::uint32_t> visible)
{
    auto* const instances = static_cast<InstanceData*>(instances_.mapped);
    auto* const commands = static_cast<VkDrawIndexedIndirectCommand*>(commands_.mapped);
    lists_ = batcher_.build(visible, 0, {commands, parts_.size()}, handles_);
    for (std::uint32_t i = 0; i < lists_.instance_count; ++i) {
        writeInstance(instances[i], handles_[i], state.objects[handles_[i]].receives, eye_ws);
    }
    blended_.clear();
    for (const vulkan::BatchDraws& draws : lists_.batches) {
        if (!materials_.all()[batches_[draws.batch].material].blended) {
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
                                          instances_.handle};
    const std::array<VkDeviceSize, 4> offsets{};
    vkCmdBindVertexBuffers(commands, 0, buffers.size(), buffers.data(), offsets.data());
    vkCmdBindIndexBuffer(commands, geometry_.indices.handle, 0, VK_INDEX_TYPE_UINT32);
}

void SceneDraws::setSides(VkCommandBuffer commands, const Batch& batch) const
{
    vkCmdSetCullMode(commands, batch.two_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
    vkCmdSetFrontFace(commands, batch.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

std::uint32_t SceneDraws::recordBatch(VkCommandBuffer commands, const Pipelines& pipelines,
                                      const vulkan::BatchDraws& some) const
{
    const Batch& batch = batches_[some.batch];
    setSides(commands, batch);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout, 1, 1,
                            &materials_.all()[batch.material].set, 0, nullptr);
    vkCmdDrawIndexedIndirect(commands, commands_.handle, some.first_command * sizeof(VkDrawIndexedIndirectCommand),
                             some.command_count, sizeof(VkDrawIndexedIndirectCommand));
    return some.command_count;
}

std::uint32_t SceneDraws::recordOpaque(VkCommandBuffer commands, const Pipelines& pipelines,
                                       VkDescriptorSet frame_set) const
{
    std::uint32_t draws = 0;
    VkPipeline bound = VK_NULL_HANDLE;
    for (const vulkan::BatchDraws& some : lists_.batches) {
        const Batch& batch = batches_[some.batch];
        const MaterialFacts& facts = materials_.all()[batch.material];
        if (facts.blended) {
            continue;
        }
        const bool first = bound == VK_NULL_HANDLE;
        if (pipelines.gbuffer(batch.kind) != bound) {
            bound = pipelines.gbuffer(batch.kind);
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, bound);
        }
        if (first) { // not before the pipeline: llvmpipe 22.3 crashes on a set that no pipeline was ever bound for
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout, 0, 1, &frame_set,
                                    0, nullptr);
            bindStreams(commands);
        }
        draws += recordBatch(commands, pipelines, some);
    }
    return draws;
}

std::uint32_t SceneDraws::recordEmissive(VkCommandBuffer commands, const Pipelines& pipelines) const
{
    std::uint32_t draws = 0;
    for (const vulkan::BatchDraws& some : lists_.batches) {
        const Batch& batch = batches_[some.batch];
        const MaterialFacts& facts = materials_.all()[batch.material];
        if (facts.blended || !facts.emits) {
            continue;
        }
        if (draws == 0) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.emissive);
        }
        draws += recordBatch(commands, pipelines, some);
    }
    return draws;
}

std::uint32_t SceneDraws::recordBlended(VkCommandBuffer commands, const Pipelines& pipelines) const
{
    if (!blended_.empty()) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.blended);
    }
    for (const Blended& one : blended_) {
        const vulkan::DrawPart& part = parts_[objects_[one.object].first_part];
        const Batch& batch = batches_[part.batch];
        setSides(commands, batch);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout, 1, 1,
                                &materials_.all()[batch.material].set, 0, nullptr);
        vkCmdDrawIndexed(commands, part.mesh.index_count, 1, part.mesh.first_index, part.mesh.vertex_offset,
                         one.instance);
    }
    return static_cast<std::uint32_t>(blended_.size());
}

void SceneDraws::fillCasters(vulkan::CasterDrawer& drawer) const
{
    drawer.setScene(caster_parts_, caster_objects_, caster_batches_);
}

vulkan::CasterGeometry SceneDraws::casterGeometry() const
{
    return {geometry_.positions.handle, 0, geometry_.uvs.handle, 0, geometry_.indices.handle, 0};
}

} // namespace gnomon::host
