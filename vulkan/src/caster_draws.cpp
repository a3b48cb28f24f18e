// SPDX-License-Identifier: Apache-2.0
// One pass of casters: who is drawn in it, by which rows, and the commands.
#include "caster_drawer_impl.h"
#include "caster_instances.h"
#include "draw_view.h"
#include "map_storage.h"
#include "usage.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon::vulkan {
namespace {

constexpr const char* kDrawing = "draw a pass of casters";
constexpr const char* kAsGiven = "hand in passes as recordMaps() gives them, of the plan that beginFrame() was given";

} // namespace

/// The casters of all its views.
std::span<const std::uint32_t> CasterDrawer::Impl::listOf(const MapPass& pass)
{
    if (pass.view_count == 1) {
        return pass.casters;
    }
    listed.clear();
    for (std::uint32_t i = 0; i < pass.view_count; ++i) {
        const auto list = pass.castersOf(i);
        listed.insert(listed.end(), list.begin(), list.end());
    }
    return listed;
}

void CasterDrawer::Impl::writeRows(const MapPass& pass, std::span<const std::uint32_t> instances)
{
    const CasterPlaces casters{transforms, biases_m};
    auto* const out = reinterpret_cast<glm::vec4*>(static_cast<std::byte*>(slot->instances.data()) + instances_used);
    if (pass.view_count > 1) {
        writeLayeredInstances(pass, instances, casters, out);
    } else if (classicFormats(pass).ids) {
        writeIdInstances(pass, instances, casters, out);
    } else {
        writeInstances(*pass.view, instances, casters, out);
    }
}

void CasterDrawer::Impl::bindGeometry(const MapPass& pass) const
{
    device.vk.CmdBindIndexBuffer(pass.commands, geometry.indices, geometry.indices_offset, options.vertices.index);
    device.vk.CmdBindVertexBuffers(pass.commands, 0, 1, &geometry.positions, &geometry.positions_offset);
    if (geometry.uvs != VK_NULL_HANDLE) {
        device.vk.CmdBindVertexBuffers(pass.commands, 2, 1, &geometry.uvs, &geometry.uvs_offset);
    }
    const VkBuffer instances = slot->instances.buffer();
    device.vk.CmdBindVertexBuffers(pass.commands, 1, 1, &instances, &instances_used);
    if (geometry.colours != VK_NULL_HANDLE) {
        device.vk.CmdBindVertexBuffers(pass.commands, kColourBinding, 1, &geometry.colours, &geometry.colours_offset);
    }
    if (classicFormats(pass).pieces) {
        device.vk.CmdBindVertexBuffers(pass.commands, kPieceBinding, 1, &geometry.pieces, &geometry.pieces_offset);
    }
    if (pass.placement != VK_NULL_HANDLE && pass.view_count == 1) {
        device.vk.CmdBindVertexBuffers(pass.commands, kPlacementBinding, 1, &pass.placement, &pass.placement_offset);
    }
}

void CasterDrawer::Impl::bindPlaces(const MapPass& pass)
{
    if (!slot->places_written) { // no command of this frame names the set yet
        const DescriptorSets::Write places = DescriptorSets::buffer(0, pass.placement);
        pipelines.places().write(slot->places, {&places, 1});
        slot->places_written = true;
    }
    device.vk.CmdBindDescriptorSets(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout(), 1, 1,
                                    &slot->places, 0, nullptr);
    const auto first = static_cast<std::int32_t>(pass.placement_offset / kPlacementStride);
    device.vk.CmdPushConstants(pass.commands, pipelines.layout(), kMaterialStages, offsetof(CasterMaterial, first_view),
                               sizeof first, &first);
}

void CasterDrawer::Impl::drawCommands(VkCommandBuffer to, const BatchDraws& draws) const
{
    const VkDeviceSize first = commands_used + draws.first_command * kCommandBytes;
    if (device.uses().indirect_draws) {
        const std::uint32_t most = std::max(device.limits().maxDrawIndirectCount, 1U);
        for (std::uint32_t i = 0; i < draws.command_count; i += std::min(most, draws.command_count - i)) {
            device.vk.CmdDrawIndexedIndirect(to, slot->commands.buffer(), first + i * kCommandBytes,
                                             std::min(most, draws.command_count - i),
                                             static_cast<std::uint32_t>(kCommandBytes));
        }
        return;
    }
    const auto* const written = reinterpret_cast<const VkDrawIndexedIndirectCommand*>(
        static_cast<const std::byte*>(slot->commands.data()) + first);
    for (const VkDrawIndexedIndirectCommand& one : std::span(written, draws.command_count)) {
        device.vk.CmdDrawIndexed(to, one.indexCount, one.instanceCount, one.firstIndex, one.vertexOffset,
                                 one.firstInstance);
    }
}

std::uint32_t CasterDrawer::Impl::drawBatch(const MapPass& pass, const BatchDraws& draws, CasterPipelineKey key)
{
    const CasterBatch& batch = batches[draws.batch];
    if (batch.blended != key.formats.blended) {
        return 0;
    }
    setBatch(key, batch);
    if (const VkPipeline pipeline = pipelines.get(key); pipeline == VK_NULL_HANDLE) {
        refuseUse(kDrawing, "it has formats that the plan of beginFrame() has not", kAsGiven);
    } else if (pipeline != bound) {
        device.vk.CmdBindPipeline(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        if (bound == VK_NULL_HANDLE && key.layered && key.placed) {
            bindPlaces(pass); // not before the pipeline [drivers: set-first]
        }
        if (bound == VK_NULL_HANDLE && key.classic.behind_first) {
            device.vk.CmdBindDescriptorSets(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout(),
                                            CasterPipelines::kFirstSurfaceSet, 1, &pass.classic->first_surface, 0,
                                            nullptr);
        }
        bound = pipeline;
    }
    if (key.masked) {
        device.vk.CmdBindDescriptorSets(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout(), 0, 1,
                                        &batch.texture, 0, nullptr);
        device.vk.CmdPushConstants(pass.commands, pipelines.layout(), kMaterialStages, 0,
                                   batch.blended ? offsetof(CasterMaterial, clip_planes)
                                                 : offsetof(CasterMaterial, first_view),
                                   &materials[draws.batch]);
    }
    if (key.clipped) {
        device.vk.CmdPushConstants(pass.commands, pipelines.layout(), kMaterialStages,
                                   offsetof(CasterMaterial, clip_planes), sizeof(CasterMaterial::clip_planes),
                                   &materials[draws.batch].clip_planes);
    }
    drawCommands(pass.commands, draws);
    return draws.command_count;
}

void CasterDrawer::Impl::checkPass(const MapPass& pass) const
{
    if (slot == nullptr) {
        refuseUse(kDrawing, "no frame has begun", "call beginFrame() first");
    }
    checkCommands(kDrawing, pass.commands);
    if (pass.view == nullptr || pass.view_count == 0 || pass.view_count > kMaxCascades) {
        refuseUse(kDrawing, "the pass has no view, or more than one pass can have", kAsGiven);
    }
    if (classicFormats(pass).ids &&
        (pass.plan == nullptr || pass.plan->lights[pass.view->light].first_object_id == kNoIndex)) {
        refuseUse(kDrawing, "the map holds ids, and the plan has none for its light", kAsGiven);
    }
    if (pass.view_count > 1 && (!together || pass.plan == nullptr || pass.view_index >= pass.plan->views.size() ||
                                pass.view_count > pass.plan->views.size() - pass.view_index)) {
        refuseUse(kDrawing, "the pass has views that the plan of beginFrame() has not", kAsGiven);
    }
}

/// beginFrame() made enough room for every pass of its plan once.
void CasterDrawer::Impl::checkRoom(const MapPass& pass, std::uint32_t instances) const
{
    const VkDeviceSize bytes = instances * VkDeviceSize{instanceBytes(!pass.view->projection.orthographic,
                                                                      pass.view_count > 1, classicFormats(pass).ids)};
    const VkDeviceSize commands = std::min(instances, batcher.maxCommands()) * kCommandBytes;
    if (instances > handles.size() || instances_used + bytes > slot->instances.size() ||
        commands_used + commands > slot->commands.size()) {
        refuseUse(kDrawing, "it has more casters than the plan of beginFrame()", kAsGiven);
    }
}

std::uint32_t CasterDrawer::draw(const MapPass& pass)
{
    Impl& self = *impl_;
    self.checkPass(pass);
    const View& view = *pass.view;
    const std::span<const std::uint32_t> list = self.listOf(pass);
    const std::uint32_t instances = self.batcher.instanceCount(list);
    if (instances == 0) {
        return 0;
    }
    self.checkRoom(pass, instances);
    Impl::Slot& slot = *self.slot;
    const bool layered = pass.view_count > 1;
    auto* commands_out = reinterpret_cast<VkDrawIndexedIndirectCommand*>(static_cast<std::byte*>(slot.commands.data()) +
                                                                         self.commands_used);
    const std::size_t commands_left = (slot.commands.size() - self.commands_used) / kCommandBytes;
    const DrawLists lists = self.batcher.build(list, 0, {commands_out, commands_left}, self.handles, layered);
    self.writeRows(pass, std::span(self.handles).first(lists.instance_count));

    self.bound = VK_NULL_HANDLE;
    self.bindGeometry(pass);
    CasterPipelineKey key;
    key.formats = pass.formats;
    key.classic = classicFormats(pass);
    key.perspective = !view.projection.orthographic;
    key.clamp = view.projection.clamp_near;
    // Blockers before blended casters are not drawn to texels that two maps share.
    const bool whole = pass.formats.blended || pass.formats.colour == VK_FORMAT_UNDEFINED;
    key.part = whole ? TexelPart::whole : view.place.part;
    key.placed = pass.placement != VK_NULL_HANDLE;
    key.layered = layered;
    std::uint32_t drawn = 0;
    for (const BatchDraws& draws : lists.batches) {
        drawn += self.drawBatch(pass, draws, key);
    }
    self.commands_used += lists.command_count * kCommandBytes;
    self.instances_used += VkDeviceSize{lists.instance_count} *
                           instanceBytes(!view.projection.orthographic, layered, classicFormats(pass).ids);
    self.triangles += lists.index_count / 3;
    return drawn;
}

} // namespace gnomon::vulkan
