// SPDX-License-Identifier: Apache-2.0
// The state of a drawer of casters, and its steps: those of a frame are in caster_drawer.cpp, those of a pass in
// caster_draws.cpp.
#pragma once

#include "caster_pipelines.h"
#include "device.h"
#include "usage.h"

#include <gnomon/vulkan/caster_drawer.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::vulkan {

inline constexpr VkDeviceSize kCommandBytes = sizeof(VkDrawIndexedIndirectCommand);

[[nodiscard]] inline bool isClipped(const CasterBatch& batch)
{
    return batch.clip_planes[0] != kNoClipPlane || batch.clip_planes[1] != kNoClipPlane;
}

struct CasterDrawer::Impl {
    // Written by beginFrame() and draw(), read by the GPU until the slot comes round again.
    struct Slot {
        HostBuffer commands;
        HostBuffer instances;
        VkDescriptorSet places = VK_NULL_HANDLE; // CasterPipelines::places()
        bool places_written = false;             // in this frame
    };

    Impl(const DeviceView& view, const CasterDrawerOptions& options_in)
        : device(view), options(options_in), pipelines(device, options_in),
          slots(checkedFrames(options_in.frames_in_flight))
    {
    }

    void reserve(const Plan& plan, Slot& begun);
    void checkPass(const MapPass& pass) const;
    void checkRoom(const MapPass& pass, std::uint32_t instances) const;
    void ensurePipelines(const Plan& plan);
    /// Views with these options get maps of tints, where their casters ask for them.
    [[nodiscard]] bool tintsWith(const ResolvedOptions& resolved) const;
    void ensureTints(CasterPipelineKey key);
    void ensureBatches(CasterPipelineKey key);
    void ensureAllPasses(CasterPipelineKey key, const ResolvedOptions& resolved);
    /// Sets the part of `key` that says how a batch is drawn.
    void setBatch(CasterPipelineKey& key, const CasterBatch& batch) const;
    [[nodiscard]] VkCullModeFlags cullOf(const CasterBatch& batch, const ClassicFormats& formats) const;
    void makePlaces(const Plan& plan);
    [[nodiscard]] std::span<const std::uint32_t> listOf(const MapPass& pass);
    void writeRows(const MapPass& pass, std::span<const std::uint32_t> instances);
    void bindGeometry(const MapPass& pass) const;
    void bindPlaces(const MapPass& pass);
    /// Returns the number of indirect draws.
    void drawCommands(VkCommandBuffer to, const BatchDraws& draws) const;
    std::uint32_t drawBatch(const MapPass& pass, const BatchDraws& draws, CasterPipelineKey key);

    Device device;
    CasterDrawerOptions options;
    CasterPipelines pipelines;
    DrawBatcher batcher;
    std::size_t object_count = 0;
    std::vector<CasterBatch> batches;
    std::vector<CasterMaterial> materials;
    std::vector<Slot> slots;
    std::vector<std::uint32_t> handles; // handles of the instances of one pass; for several views places in `listed`
    std::vector<std::uint32_t> listed;  // casters of the views of one pass, one list after the other
    std::vector<float> biases_m;        // by object index
    bool tints = false;                 // some batch is blended
    bool reads_uvs = false;             // some batch has a texture
    bool reads_colours = false;         // and vertex colours
    bool together = false;              // some of this plan's views may be drawn in passes of several

    // This frame's.
    Slot* slot = nullptr;
    CasterGeometry geometry;
    std::span<const Rows3x4> transforms;
    VkDeviceSize commands_used = 0;
    VkDeviceSize instances_used = 0;
    std::uint64_t triangles = 0;
    VkPipeline bound = VK_NULL_HANDLE;
};

} // namespace gnomon::vulkan
