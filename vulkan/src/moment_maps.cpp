// SPDX-License-Identifier: Apache-2.0
#include "moment_maps.h"

#include "blur_kernel.h"
#include "draw_view.h"
#include "moment_rule_of.h"
#include "timed.h"

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

constexpr VkPipelineStageFlags2 kShaders =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;

/// Checks before anything is made.
Device& checkedDevice(Device& device, const FilterOptions& filter, const MapStorage& storage)
{
    requireAveraging(device.features(storage.colour), filter.filter, filter.format, "create the shadow renderer");
    return device;
}

std::uint32_t alignedCounts(const Device& device)
{
    const VkDeviceSize align = std::max<VkDeviceSize>(device.limits().minStorageBufferOffsetAlignment, 16);
    return static_cast<std::uint32_t>((sizeof(shared::BlurCounts) + align - 1) / align * align);
}

} // namespace

MomentMaps::MomentMaps(Device& device, const ShadowRendererOptions& options, const MapStorage& storage,
                       LayerPlacer& placer)
    : device_(checkedDevice(device, options.filter, storage)), filter_(options.filter), storage_(storage),
      placer_(placer), slots_(options.frames_in_flight), counts_stride_(alignedCounts(device)),
      layers_per_map_(imageLayersPerMap(filter_.filter, filter_.moments)), layout_(device, options.pipeline_cache),
      moments_(layout_, filter_), mips_(layout_, filterConstants(filter_))
{
    images_.kernel =
        HostBuffer(device, sizeof(shared::BlurKernel), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "shadow filter buffers");
    if (blurRadius(filter_.moments) > 0) {
        const BlurPath path = filter_.moments.blur_path;
        blur_.emplace(layout_, filterConstants(filter_), storage.colour,
                      path == BlurPath::automatic ? BlurPath::compute : path);
        *static_cast<shared::BlurKernel*>(images_.kernel.data()) = blurKernel(filter_.moments);
    }
    images_.counts = HostBuffer(device, VkDeviceSize{counts_stride_} * slots_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                "shadow filter buffers");
    for (std::uint32_t slot = 0; slot < slots_; ++slot) {
        counts(slot) = {};
    }
}

MomentMaps::Need MomentMaps::needOf(const Plan& plan)
{
    const MapPages& atlas = plan.pages[0];
    Need need;
    need.atlas = {std::max(atlas.width, 1U), std::max(atlas.height, 1U), std::max(atlas.layers, 1U)};
    need.tile = {1, 1};
    for (const View& view : plan.views) {
        need.tile.width = std::max(need.tile.width, view.tile.width);
        need.tile.height = std::max(need.tile.height, view.tile.height);
    }
    need.kept_layers = plan.pages[0].kept_layers;
    return need;
}

bool MomentMaps::fits(const Need& need) const
{
    const auto covers = [](const Image& image, std::uint32_t width, std::uint32_t height) {
        return image && image.info().extent.width >= width && image.info().extent.height >= height;
    };
    return ready_ && covers(images_.maps, need.atlas.width, need.atlas.height) &&
           images_.maps.info().layers >= need.atlas.layers * layers_per_map_ &&
           images_.maps.info().levels >= mipLevels(filter_, need.atlas.width, need.atlas.height) &&
           (!blur_ || covers(images_.scratch, need.tile.width, need.tile.height)) &&
           kept_.layers() >= need.kept_layers &&
           images_.blocks.size() >= std::size_t{4} * groupsOf(need.tile.width, shared::kBlockTexels) *
                                        groupsOf(need.tile.height, shared::kBlockTexels);
}

void MomentMaps::makeImages(const Need& need)
{
    // Free the old images first, so that growing does not need room for both.
    ready_ = false;
    layout_of_maps_ = VK_IMAGE_LAYOUT_UNDEFINED;
    images_.maps = {};
    images_.depth = {};
    kept_ = {};
    images_.scratch = {};
    images_.blocks = {};
    constexpr VkImageUsageFlags kColour =
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    const VkExtent2D extent{need.atlas.width, need.atlas.height};
    ImageInfo maps;
    maps.format = storage_.colour;
    maps.extent = extent;
    maps.layers = need.atlas.layers * layers_per_map_;
    maps.usage = kColour | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    maps.purpose = "shadow maps";
    maps.levels = mipLevels(filter_, extent.width, extent.height);
    images_.maps = Image(device_, maps);
    ImageInfo depth;
    depth.format = storage_.depth;
    depth.extent = extent;
    depth.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    depth.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    depth.purpose = "shadow map depth";
    depth.samples = static_cast<VkSampleCountFlagBits>(filter_.moments.samples);
    if (need.kept_layers > 0) {
        depth.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    }
    images_.depth = Image(device_, depth);
    if (need.kept_layers > 0) {
        kept_ = KeptDepth(device_, depth, need.kept_layers);
    }
    if (blur_) {
        ImageInfo scratch;
        scratch.format = storage_.colour;
        scratch.extent = need.tile;
        scratch.layers = layers_per_map_;
        scratch.usage = kColour | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        scratch.purpose = "shadow blur";
        images_.scratch = Image(device_, scratch);
    }
    const VkDeviceSize blocks = VkDeviceSize{groupsOf(need.tile.width, shared::kBlockTexels)} *
                                groupsOf(need.tile.height, shared::kBlockTexels);
    images_.blocks =
        DeviceBuffer(device_, 4 * blocks, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     "shadow filter buffers");
    cleared_ = false;
}

void MomentMaps::makeSets()
{
    images_.depth_layers = placer_.buffer();
    layout_.reset(MomentPass::kSets + (blur_ ? BlurPass::kSets : 0) + MipPass::sets(images_.maps.info().levels));
    moments_.makeSets(images_);
    if (blur_) {
        blur_->makeSets(images_);
    }
    mips_.makeSets(images_);
}

bool MomentMaps::prepare(const Plan& plan)
{
    const bool layers_changed = placer_.prepare(plan);
    const Need need = needOf(plan);
    const bool fit = fits(need);
    if (!fit) {
        placer_.forgetDepth();
        makeImages(need);
    }
    if (!fit || layers_changed) {
        makeSets();
        ready_ = true;
        redraw_all_ = true;
        return true;
    }
    return false;
}

MapPassFormats MomentMaps::formats(bool orthographic) const
{
    return {VK_FORMAT_UNDEFINED, storage_.depth, static_cast<VkSampleCountFlagBits>(filter_.moments.samples),
            !orthographic};
}

// The image as a whole: sets name all of its layers, and are used with all of them in one layout.
void MomentMaps::toLayout(VkCommandBuffer commands, VkImageLayout layout)
{
    ImageBarrier barrier;
    barrier.image = images_.maps.image();
    barrier.layer_count = images_.maps.info().layers;
    barrier.old_layout = layout_of_maps_; // not UNDEFINED: tiles that are kept must not be lost
    barrier.new_layout = layout;
    barrier.source_stages = kMapReaders; // the last frame's reads come first; there is nothing to make visible
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    if (layout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
        // The last writer: the pass of the mip levels or of the moments, or a blur, which waited for itself already.
        barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        barrier.target_stages = kMapReaders;
        barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    }
    recordBarrier(device_, commands, barrier);
    layout_of_maps_ = layout;
}

void MomentMaps::makeReadable(VkCommandBuffer commands)
{
    clearNewImages(commands);
    if (layout_of_maps_ != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
        toLayout(commands, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
}

// A filtered read at the edge of a tile or of a block touches texels beside it with weight 0. New memory may hold NaN
// there, and 0 times that is not 0.
void MomentMaps::clearNewImages(VkCommandBuffer commands)
{
    if (cleared_) {
        return;
    }
    for (const Image* image : {&images_.maps, &images_.scratch}) {
        if (!*image) {
            continue;
        }
        ImageBarrier barrier;
        barrier.image = image->image();
        barrier.layer_count = image->info().layers;
        barrier.new_layout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        recordBarrier(device_, commands, barrier);
        const VkClearColorValue zeros{};
        const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                          VK_REMAINING_ARRAY_LAYERS};
        device_.vk.CmdClearColorImage(commands, image->image(), VK_IMAGE_LAYOUT_GENERAL, &zeros, 1, &all);
        barrier.old_layout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.target_stages = kShaders | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
        barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                                VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
        recordBarrier(device_, commands, barrier);
    }
    layout_of_maps_ = VK_IMAGE_LAYOUT_GENERAL;
    cleared_ = true;
}

void MomentMaps::record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                        Profiler* profiler)
{
    assert(slot < slots_);
    counts(slot) = {}; // the GPU has finished with the slot
    bool drawn = false;
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        if (!plan.views[i].redraw && !redraw_all_) {
            continue;
        }
        drawn = true;
        clearNewImages(commands);
        if (layout_of_maps_ != VK_IMAGE_LAYOUT_GENERAL) {
            toLayout(commands, VK_IMAGE_LAYOUT_GENERAL);
        }
        {
            const Timed timed(profiler, commands, "shadow maps");
            recordDepth(commands, plan, i, draw);
        }
        const Timed timed(profiler, commands, "shadow filter");
        recordFilter(commands, slot, plan, i);
    }
    redraw_all_ = false;
    makeReadable(commands);
    if (blur_ && drawn) {
        // For cost().
        MemoryBarrier barrier;
        barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        barrier.target_stages = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.target_access = VK_ACCESS_2_HOST_READ_BIT;
        recordBarrier(device_, commands, barrier);
    }
}

void MomentMaps::recordDepth(VkCommandBuffer commands, const Plan& plan, std::uint32_t index, const DrawCasters& draw)
{
    const View& view = plan.views[index];
    assert(view.tile.x + view.tile.width <= images_.maps.info().extent.width &&
           view.tile.y + view.tile.height <= images_.maps.info().extent.height);
    beginViewLabel(device_, commands, plan, index);
    ImageBarrier barrier;
    barrier.image = images_.depth.image();
    barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    if (view.kept_layer != kNoIndex) {
        if (view.redraw_kept || redraw_all_) {
            kept_.draw(commands, plan, index, draw);
        }
        kept_.restore(commands, view, images_.depth);
        beginDepthRendering(device_, commands, view.tile, images_.depth.layer(0), VK_ATTACHMENT_LOAD_OP_LOAD);
        drawView(commands, plan, index, CasterShare::moving, 0, draw);
    } else {
        barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL; // what the view before left is not needed
        barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.target_stages = kDepthStages;
        barrier.target_access = kDepthAccess;
        recordBarrier(device_, commands, barrier);
        beginDepthRendering(device_, commands, view.tile, images_.depth.layer(0), VK_ATTACHMENT_LOAD_OP_CLEAR);
        drawView(commands, plan, index, CasterShare::all, 0, draw);
    }
    device_.vk.CmdEndRendering(commands);
    barrier.old_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.source_stages = kDepthStages;
    barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    recordBarrier(device_, commands, barrier);
    device_.endLabel(commands);
}

void MomentMaps::recordFilter(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, std::uint32_t index)
{
    const View& view = plan.views[index];
    FilterStep step;
    step.commands = commands;
    step.tile = view.tile;
    step.first_layer = view.tile.layer * layers_per_map_;
    step.image_layers = layers_per_map_;
    step.depth_slot = placer_.slotOf(index);
    step.near_over_far = view.parallel ? 1.0F : static_cast<float>(view.metric.near_m / view.metric.far_m);
    step.counts_offset = slot * counts_stride_;

    // The flags of the view before were read by both kinds of shaders.
    MemoryBarrier barrier;
    barrier.source_stages = kShaders;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    recordBarrier(device_, commands, barrier);
    device_.vk.CmdFillBuffer(commands, images_.blocks.buffer(), 0, VK_WHOLE_SIZE, 0);
    placer_.record(commands, plan, index, images_.depth.layer(0));
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device_, commands, barrier);

    moments_.record(step);
    waitForShaders(device_, commands);
    if (blur_) {
        blur_->record(step, images_);
    }
    mips_.record(step);
}

shared::BlurCounts& MomentMaps::counts(std::uint32_t slot) const
{
    auto* bytes = static_cast<std::byte*>(images_.counts.data()) + std::size_t{slot} * counts_stride_;
    return *reinterpret_cast<shared::BlurCounts*>(bytes);
}

FilterCost MomentMaps::cost(std::uint32_t slot) const
{
    assert(slot < slots_);
    return blur_ ? blur_->cost(counts(slot)) : FilterCost{};
}

} // namespace gnomon::vulkan
