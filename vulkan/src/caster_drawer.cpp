// SPDX-License-Identifier: Apache-2.0
// The scene, and what a frame needs before its passes are drawn (caster_draws.cpp).
#include "caster_drawer_impl.h"
#include "caster_instances.h"
#include "draw_view.h"
#include "tint_maps.h"
#include "usage.h"

#include <gnomon/plan_views.h>
#include <gnomon/shared/alpha_cutoff.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gnomon::vulkan {
namespace {

constexpr const char* kBeginning = "begin a frame of casters";

CasterMaterial material(const CasterBatch& batch)
{
    // KHR_texture_transform: translation * rotation * scale, the rotation counter-clockwise with v pointing down.
    const float c = std::cos(batch.uv_rotation_rad);
    const float s = std::sin(batch.uv_rotation_rad);
    return {{c * batch.uv_scale.x, s * batch.uv_scale.y, batch.uv_offset.x, 0.0F},
            {-s * batch.uv_scale.x, c * batch.uv_scale.y, batch.uv_offset.y, 0.0F},
            batch.blended ? float(batch.stained) : shared::alphaLimit(batch.cutoff),
            0,
            {},
            batch.tint,
            batch.clip_planes};
}

bool isFinite(const CasterBatch& batch)
{
    return std::ranges::all_of(batch.clip_planes, [](const glm::vec4& plane) {
        return std::isfinite(plane.x) && std::isfinite(plane.y) && std::isfinite(plane.z) && std::isfinite(plane.w);
    });
}

bool readsUvs(const CasterBatch& batch)
{
    return batch.texture != VK_NULL_HANDLE;
}

bool readsColours(const CasterBatch& batch)
{
    return batch.vertex_colours && batch.texture != VK_NULL_HANDLE;
}

} // namespace

CasterDrawer::CasterDrawer(const DeviceView& device, const CasterDrawerOptions& options)
    : impl_(std::make_unique<Impl>(device, options))
{
}

CasterDrawer::~CasterDrawer() = default;

void CasterDrawer::setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects,
                            std::span<const CasterBatch> batches)
{
    if (std::ranges::any_of(parts, [&](const DrawPart& part) { return part.batch >= batches.size(); })) {
        refuseUse("list what objects draw", "a part names a batch that there is not", "hand in all batches");
    }
    if (!std::ranges::all_of(batches, isFinite)) {
        refuseUse("list what objects draw", "a clip plane of a batch is not finite", "give four numbers");
    }
    const bool reads_uvs = std::ranges::any_of(batches, readsUvs);
    if (reads_uvs && impl_->options.vertices.uv.format == VK_FORMAT_UNDEFINED) {
        refuseUse("list what objects draw", "a batch has a texture, and vertices have no texture coordinates",
                  "fill in CasterVertices::uv");
    }
    const bool reads_colours = std::ranges::any_of(batches, readsColours);
    if (reads_colours && impl_->options.vertices.colour.format == VK_FORMAT_UNDEFINED) {
        refuseUse("list what objects draw", "a batch has vertex colours, and vertices have none",
                  "fill in CasterVertices::colour");
    }
    // All of the scene or, when memory runs out, none of it.
    DrawBatcher batcher;
    batcher.setScene(parts, objects);
    std::vector<CasterBatch> copied(batches.begin(), batches.end());
    std::vector<CasterMaterial> materials;
    for (const CasterBatch& batch : batches) {
        materials.push_back(material(batch));
    }
    impl_->object_count = objects.size();
    impl_->batcher = std::move(batcher);
    impl_->batches = std::move(copied);
    impl_->materials = std::move(materials);
    impl_->reads_uvs = reads_uvs;
    impl_->reads_colours = reads_colours;
    impl_->tints = std::ranges::any_of(impl_->batches, &CasterBatch::blended);
}

void CasterDrawer::setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects)
{
    const CasterBatch opaque;
    setScene(parts, objects, {&opaque, 1});
}

DrawCasters CasterDrawer::callback()
{
    return [this](const MapPass& pass) {
        draw(pass);
    };
}

void CasterDrawer::setBiases(std::span<const float> bias_m)
{
    if (!std::ranges::all_of(bias_m, [](float bias) { return std::isfinite(bias); })) {
        refuseUse("take biases of objects", "one is no finite number", "give metres");
    }
    impl_->biases_m.assign(bias_m.begin(), bias_m.end());
}

bool CasterDrawer::Impl::tintsWith(const ResolvedOptions& resolved) const
{
    return tints && resolved.asked().translucent != Translucent::none;
}

// Views that need no redraw are counted too, so that a frame that redraws them all finds its room.
void CasterDrawer::Impl::reserve(const Plan& plan, Slot& begun)
{
    VkDeviceSize all_instances = 0;
    VkDeviceSize all_commands = 0;
    std::uint32_t most = 0;
    std::size_t most_listed = 0;
    for (std::uint32_t i = 0; i < plan.views.size();) {
        const std::uint32_t end = i + (isDrawnTogether(plan, i) ? viewsTogether(plan, i, true) : 1);
        std::uint32_t in_pass = 0;
        std::size_t listed_in_pass = 0;
        for (; i < end; ++i) {
            // Still and moving casters may be drawn apart.
            const std::uint32_t for_tints =
                tintsWith(optionsOf(plan, plan.views[i])) ? 2 : 0; // blockers, and blended casters
            const std::uint32_t passes = (isDrawnTwice(optionsOf(plan, plan.views[i])) ? 2 : 1) + for_tints;
            for (const pack::CasterShare share : {pack::CasterShare::still, pack::CasterShare::moving}) {
                const auto list = pack::castersOf(plan, plan.views[i], share);
                const std::uint32_t count = batcher.instanceCount(list);
                all_instances += VkDeviceSize{passes} * count;
                all_commands += VkDeviceSize{passes} * std::min(count, batcher.maxCommands());
                in_pass += count;
                listed_in_pass += list.size();
            }
        }
        most = std::max(most, in_pass);
        most_listed = std::max(most_listed, listed_in_pass);
    }
    const auto grow = [&](HostBuffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage, const char* purpose) {
        if (buffer.size() < bytes) {
            buffer = {}; // gives its memory back first
            buffer = HostBuffer(device, bytes + bytes / 2, usage, purpose);
        }
    };
    grow(begun.commands, all_commands * kCommandBytes, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, "draw commands");
    const bool ids =
        std::ranges::any_of(plan.lights, [](const LightPlan& light) { return light.first_object_id != kNoIndex; });
    grow(begun.instances, all_instances * instanceBytes(true, together, ids), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
         "instances");
    if (handles.size() < most) {
        handles.resize(most + most / 2);
    }
    if (together) {
        listed.reserve(most_listed + most_listed / 2);
    }
}

/// For whichever of its views the renderer may find that it has to draw.
void CasterDrawer::Impl::ensurePipelines(const Plan& plan)
{
    std::uint32_t end_of_group = 0;
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        if (i >= end_of_group && isDrawnTogether(plan, i)) {
            end_of_group = i + viewsTogether(plan, i, true);
        }
        CasterPipelineKey key;
        key.formats = mapFormats(optionsOf(plan, view), view.projection.orthographic);
        key.classic = classicFormats(optionsOf(plan, view));
        key.perspective = !view.projection.orthographic;
        key.clamp = view.projection.clamp_near;
        key.part = view.place.part;
        key.placed = view.projection.gpu_cascade != kNoIndex;
        ensureAllPasses(key, optionsOf(plan, view));
        if (i + 1 < end_of_group) { // with the next one at least
            key.layered = true;
            ensureBatches(key);
        }
    }
}

/// Pipelines take counter-clockwise triangles for front faces, so of a batch that winds the other way the other ones
/// are left out.
VkCullModeFlags CasterDrawer::Impl::cullOf(const CasterBatch& batch, const ClassicFormats& formats) const
{
    const bool may_be_cut = !batch.two_sided && !isClipped(batch);
    CasterCull cull = formats.cull;
    if (cull == CasterCull::none && may_be_cut) {
        cull = formats.back_faces ? CasterCull::front : options.cull_back_faces ? CasterCull::back : CasterCull::none;
    }
    if (cull == CasterCull::none) {
        return VK_CULL_MODE_NONE;
    }
    const bool winds_back = options.clockwise_front != batch.mirrored;
    return (cull == CasterCull::front) != winds_back ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
}

void CasterDrawer::Impl::setBatch(CasterPipelineKey& key, const CasterBatch& batch) const
{
    key.masked = batch.texture != VK_NULL_HANDLE;
    key.coloured = readsColours(batch);
    key.clipped = isClipped(batch);
    key.cull = cullOf(batch, key.classic);
}

/// For its map of tints: what blocks light before the blended casters, and these.
void CasterDrawer::Impl::ensureTints(CasterPipelineKey key)
{
    key.part = TexelPart::whole;
    key.classic = {.paraboloid = key.classic.paraboloid};
    key.formats = blockerFormats(!key.perspective);
    ensureBatches(key);
    key.formats = tintFormats();
    ensureBatches(key);
}

void CasterDrawer::Impl::ensureBatches(CasterPipelineKey key)
{
    for (const CasterBatch& batch : batches) {
        if (batch.blended != key.formats.blended) {
            continue;
        }
        setBatch(key, batch);
        pipelines.ensure(key);
    }
}

/// A midpoint's map has a second pass, and beside any map there may be a map of tints.
void CasterDrawer::Impl::ensureAllPasses(CasterPipelineKey key, const ResolvedOptions& resolved)
{
    ensureBatches(key);
    if (tintsWith(resolved) && !key.layered) {
        ensureTints(key);
    }
    if (isDrawnTwice(resolved)) {
        key.classic.behind_first = true;
        ensureBatches(key);
    }
}

void CasterDrawer::warmUp(const ResolvedOptions& options, bool perspective)
{
    const Technique& technique = options.technique();
    const bool placed = options.fitsOnGpu();
    const bool layered = options.cascades().pass == CascadePass::layered;
    const bool paired =
        options.paired_maps() && (technique.motion == Motion::step_band || technique.motion == Motion::step_blend ||
                                  technique.motion == Motion::step_alternate);
    for (unsigned bits = 0; bits < 16; ++bits) {
        CasterPipelineKey key;
        key.perspective = (bits & 1U) != 0;
        key.clamp = (bits & 2U) != 0;
        key.placed = (bits & 4U) != 0;
        key.layered = (bits & 8U) != 0;
        key.formats = mapFormats(options, !key.perspective);
        key.classic = classicFormats(options);
        if ((key.perspective && !perspective) || (key.placed && !placed) || (key.layered && !layered)) {
            continue;
        }
        impl_->ensureAllPasses(key, options);
        if (paired && !key.layered) {
            for (const TexelPart part : {TexelPart::first, TexelPart::second}) {
                key.part = part;
                impl_->ensureBatches(key);
            }
        }
    }
}

/// The buffers from which passes of several views read the places that the GPU has found.
void CasterDrawer::Impl::makePlaces(const Plan& plan)
{
    const bool was_together = together;
    together = false;
    for (std::uint32_t i = 0; i < plan.views.size() && !together; ++i) {
        together = isDrawnTogether(plan, i);
    }
    for (Slot& one : slots) {
        if (together != was_together) { // either way has its own need of room
            device.retire(std::move(one.instances));
        }
    }
    if (!together || slots.front().places != VK_NULL_HANDLE) {
        return;
    }
    pipelines.places().reset(static_cast<std::uint32_t>(slots.size()));
    std::vector<VkDescriptorSet> taken; // all or none
    for (std::size_t i = 0; i < slots.size(); ++i) {
        taken.push_back(pipelines.places().take("caster places"));
    }
    for (std::size_t i = 0; i < slots.size(); ++i) {
        slots[i].places = taken[i];
    }
}

void CasterDrawer::beginFrame(std::uint32_t slot, const Plan& plan, const CasterGeometry& geometry,
                              std::span<const Rows3x4> world_from_object)
{
    checkSlot(kBeginning, slot, static_cast<std::uint32_t>(impl_->slots.size()));
    pack::checkPlan(kBeginning, plan);
    if (world_from_object.size() < impl_->object_count) {
        refuseUse(kBeginning, "there are fewer transforms than objects", "give one for each object of setScene()");
    }
    if (impl_->object_count > 0 && (geometry.positions == VK_NULL_HANDLE || geometry.indices == VK_NULL_HANDLE)) {
        refuseUse(kBeginning, "the buffer of positions or of indices is null", "fill in CasterGeometry");
    }
    if (impl_->object_count > 0 && impl_->reads_uvs && geometry.uvs == VK_NULL_HANDLE) {
        refuseUse(kBeginning, "a batch has a texture, and the buffer of texture coordinates is null",
                  "fill in CasterGeometry::uvs");
    }
    if (impl_->object_count > 0 && impl_->reads_colours && geometry.colours == VK_NULL_HANDLE) {
        refuseUse(kBeginning, "a batch has vertex colours, and the buffer of colours is null",
                  "fill in CasterGeometry::colours");
    }
    if (geometry.pieces == VK_NULL_HANDLE && hasPieces(plan)) {
        refuseUse(kBeginning, "id.of face tells pieces of objects apart, and the buffer of pieces is null",
                  "fill in CasterGeometry::pieces");
    }
    impl_->slot = nullptr;                               // until all of it is there
    impl_->device.enter(slot, Retirement::Work::bounds); // a new frame each time
    Impl::Slot* const begun = &impl_->slots[slot];
    impl_->geometry = geometry;
    impl_->transforms = world_from_object;
    impl_->commands_used = 0;
    impl_->instances_used = 0;
    impl_->triangles = 0;
    begun->places_written = false;
    impl_->makePlaces(plan);
    impl_->reserve(plan, *begun);
    impl_->ensurePipelines(plan);
    impl_->slot = begun;
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
