// SPDX-License-Identifier: Apache-2.0
#include "caster_pipelines.h"
#include "draw_view.h"

#include <gnomon/vulkan/caster_drawer.h>

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace gnomon::vulkan {
namespace {

constexpr VkDeviceSize kCommandBytes = sizeof(VkDrawIndexedIndirectCommand);
constexpr VkDeviceSize kMostInstanceBytes = instanceRows(true) * sizeof(glm::vec4);

CasterMaterial material(const CasterBatch& batch)
{
    // KHR_texture_transform: translation * rotation * scale, the rotation counter-clockwise with v pointing down.
    const float c = std::cos(batch.uv_rotation_rad);
    const float s = std::sin(batch.uv_rotation_rad);
    return {{c * batch.uv_scale.x, s * batch.uv_scale.y, batch.uv_offset.x, 0.0F},
            {-s * batch.uv_scale.x, c * batch.uv_scale.y, batch.uv_offset.y, 0.0F},
            batch.cutoff};
}

// Row vector of the map times an object's transform: what the vertex shader multiplies the object's own points by.
glm::vec4 composed(const glm::dvec4& row, const Rows3x4& t)
{
    return {row.x * glm::dvec4(t.x) + row.y * glm::dvec4(t.y) + row.z * glm::dvec4(t.z) +
            glm::dvec4(0.0, 0.0, 0.0, row.w)};
}

} // namespace

struct CasterDrawer::Impl {
    // Written by beginFrame() and draw(), read by the GPU until the slot comes round again.
    struct Slot {
        HostBuffer commands;
        HostBuffer instances;
    };

    Impl(const DeviceView& view, const CasterDrawerOptions& options_in)
        : device(view), options(options_in), pipelines(device, options_in), slots(options_in.frames_in_flight)
    {
    }

    void reserve(const Plan& plan);
    void ensurePipelines(const Plan& plan);
    void writeInstances(const View& view, std::span<const std::uint32_t> handles, glm::vec4* out) const;
    void bindGeometry(VkCommandBuffer commands, VkDeviceSize instances_offset) const;
    void drawBatch(VkCommandBuffer commands, const BatchDraws& draws, CasterPipelineKey key,
                   VkDeviceSize commands_offset);

    Device device;
    CasterDrawerOptions options;
    CasterPipelines pipelines;
    DrawBatcher batcher;
    std::vector<CasterBatch> batches;
    std::vector<CasterMaterial> materials;
    std::vector<Slot> slots;
    std::vector<std::uint32_t> handles; // of the instances of one view

    // This frame's.
    Slot* slot = nullptr;
    CasterGeometry geometry;
    std::span<const Rows3x4> transforms;
    VkDeviceSize commands_used = 0;
    VkDeviceSize instances_used = 0;
    std::uint64_t triangles = 0;
    VkPipeline bound = VK_NULL_HANDLE;
};

CasterDrawer::CasterDrawer(const DeviceView& device, const CasterDrawerOptions& options)
{
    assert(options.frames_in_flight > 0);
    impl_ = std::make_unique<Impl>(device, options);
}

CasterDrawer::~CasterDrawer() = default;

void CasterDrawer::setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects,
                            std::span<const CasterBatch> batches)
{
    assert(std::all_of(parts.begin(), parts.end(), [&](const DrawPart& p) { return p.batch < batches.size(); }));
    impl_->batcher.setScene(parts, objects);
    impl_->batches.assign(batches.begin(), batches.end());
    impl_->materials.clear();
    for (const CasterBatch& batch : batches) {
        impl_->materials.push_back(material(batch));
    }
}

// Views that need no redraw are counted too, so that a frame that redraws them all finds its room.
void CasterDrawer::Impl::reserve(const Plan& plan)
{
    VkDeviceSize all_instances = 0;
    VkDeviceSize all_commands = 0;
    std::uint32_t most = 0;
    for (const View& view : plan.views) {
        // What stands still and what moves may be drawn apart.
        for (const CasterShare share : {CasterShare::still, CasterShare::moving}) {
            const std::uint32_t count = batcher.instanceCount(castersOf(plan, view, share));
            all_instances += count;
            all_commands += std::min(count, batcher.maxCommands());
        }
        most = std::max(most, batcher.instanceCount(castersOf(plan, view, CasterShare::all)));
    }
    const auto grow = [&](HostBuffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage, const char* purpose) {
        if (buffer.size() < bytes) {
            buffer = {};
            buffer = HostBuffer(device, bytes + bytes / 2, usage, purpose);
        }
    };
    grow(slot->commands, all_commands * kCommandBytes, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, "draw commands");
    grow(slot->instances, all_instances * kMostInstanceBytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "instances");
    if (handles.size() < most) {
        handles.resize(most + most / 2);
    }
}

void CasterDrawer::Impl::ensurePipelines(const Plan& plan)
{
    for (const View& view : plan.views) {
        for (const CasterBatch& batch : batches) {
            pipelines.ensure({!view.orthographic, batch.texture != VK_NULL_HANDLE, view.clamp_near,
                              options.cull_back_faces && !batch.two_sided, view.part, view.gpu_cascade != kNoIndex});
        }
    }
}

void CasterDrawer::beginFrame(std::uint32_t slot, const Plan& plan, const CasterGeometry& geometry,
                              std::span<const Rows3x4> world_from_object)
{
    assert(slot < impl_->slots.size());
    impl_->slot = &impl_->slots[slot];
    impl_->geometry = geometry;
    impl_->transforms = world_from_object;
    impl_->commands_used = 0;
    impl_->instances_used = 0;
    impl_->triangles = 0;
    impl_->reserve(plan);
    impl_->ensurePipelines(plan);
}

void CasterDrawer::Impl::writeInstances(const View& view, std::span<const std::uint32_t> list, glm::vec4* out) const
{
    const glm::dvec4 x = glm::row(view.clip_from_world, 0);
    const glm::dvec4 y = glm::row(view.clip_from_world, 1);
    const glm::dvec4 metric = view.metric.metric_ws;
    if (view.orthographic) {
        for (const std::uint32_t handle : list) {
            const Rows3x4& t = transforms[handle];
            *out++ = composed(x, t);
            *out++ = composed(y, t);
            *out++ = composed(metric, t);
        }
        return;
    }
    const glm::dvec4 z = glm::row(view.clip_from_world, 2);
    const glm::dvec4 w = glm::row(view.clip_from_world, 3);
    for (const std::uint32_t handle : list) {
        const Rows3x4& t = transforms[handle];
        *out++ = composed(x, t);
        *out++ = composed(y, t);
        *out++ = composed(z, t);
        *out++ = composed(w, t);
        *out++ = composed(metric, t);
    }
}

void CasterDrawer::Impl::bindGeometry(VkCommandBuffer commands, VkDeviceSize instances_offset) const
{
    device.vk.CmdBindIndexBuffer(commands, geometry.indices, geometry.indices_offset, VK_INDEX_TYPE_UINT32);
    device.vk.CmdBindVertexBuffers(commands, 0, 1, &geometry.positions, &geometry.positions_offset);
    if (geometry.uvs != VK_NULL_HANDLE) {
        device.vk.CmdBindVertexBuffers(commands, 2, 1, &geometry.uvs, &geometry.uvs_offset);
    }
    const VkBuffer instances = slot->instances.buffer();
    device.vk.CmdBindVertexBuffers(commands, 1, 1, &instances, &instances_offset);
}

void CasterDrawer::Impl::drawBatch(VkCommandBuffer commands, const BatchDraws& draws, CasterPipelineKey key,
                                   VkDeviceSize commands_offset)
{
    const CasterBatch& batch = batches[draws.batch];
    key.masked = batch.texture != VK_NULL_HANDLE;
    key.cull = options.cull_back_faces && !batch.two_sided;
    if (const VkPipeline pipeline = pipelines.get(key); pipeline != bound) {
        device.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        bound = pipeline;
    }
    if (key.masked) {
        device.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout(), 0, 1,
                                        &batch.texture, 0, nullptr);
        device.vk.CmdPushConstants(commands, pipelines.layout(), kMaterialStages, 0, sizeof(CasterMaterial),
                                   &materials[draws.batch]);
    }
    device.vk.CmdDrawIndexedIndirect(commands, slot->commands.buffer(),
                                     commands_offset + draws.first_command * kCommandBytes, draws.command_count,
                                     static_cast<std::uint32_t>(kCommandBytes));
}

std::uint32_t CasterDrawer::draw(const MapPass& pass)
{
    Impl& self = *impl_;
    assert(self.slot != nullptr);
    const View& view = *pass.view;
    if (self.batcher.instanceCount(pass.casters) == 0) {
        return 0;
    }
    Impl::Slot& slot = *self.slot;
    auto* commands_out = reinterpret_cast<VkDrawIndexedIndirectCommand*>(static_cast<std::byte*>(slot.commands.data()) +
                                                                         self.commands_used);
    const std::size_t commands_left = (slot.commands.size() - self.commands_used) / kCommandBytes;
    const DrawLists lists = self.batcher.build(pass.casters, 0, {commands_out, commands_left}, self.handles);
    const VkDeviceSize instance_bytes =
        VkDeviceSize{lists.instance_count} * instanceRows(!view.orthographic) * sizeof(glm::vec4);
    assert(self.instances_used + instance_bytes <= slot.instances.size());
    self.writeInstances(
        view, std::span(self.handles).first(lists.instance_count),
        reinterpret_cast<glm::vec4*>(static_cast<std::byte*>(slot.instances.data()) + self.instances_used));

    self.bound = VK_NULL_HANDLE;
    self.bindGeometry(pass.commands, self.instances_used);
    const bool placed = pass.placement != VK_NULL_HANDLE;
    if (placed) {
        self.device.vk.CmdBindVertexBuffers(pass.commands, kPlacementBinding, 1, &pass.placement,
                                            &pass.placement_offset);
    }
    const CasterPipelineKey key{!view.orthographic, false, view.clamp_near, false, view.part, placed};
    for (const BatchDraws& draws : lists.batches) {
        self.drawBatch(pass.commands, draws, key, self.commands_used);
    }
    self.commands_used += lists.command_count * kCommandBytes;
    self.instances_used += instance_bytes;
    self.triangles += lists.index_count / 3;
    return lists.command_count;
}

std::uint64_t CasterDrawer::triangles() const
{
    return impl_->triangles;
}

VkDescriptorSetLayout CasterDrawer::textureSetLayout() const
{
    return impl_->pipelines.textureSetLayout();
}

std::span<const MemoryUse> CasterDrawer::memory() const
{
    return impl_->device.account().uses();
}

} // namespace gnomon::vulkan
