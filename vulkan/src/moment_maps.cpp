// SPDX-License-Identifier: Apache-2.0
#include "moment_maps.h"

#include "barriers.h"
#include "draw_view.h"
#include "timed.h"

#include <gnomon/pack/filter_rule.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

/// Checks before anything is made.
Device& checkedDevice(Device& device, const ResolvedOptions& options, const MapStorage& storage)
{
    requireAveraging(device.features(storage.colour), options.filter(), options.format(), "make shadow maps");
    return device;
}

std::uint32_t alignedCounts(const Device& device)
{
    const VkDeviceSize align = std::max<VkDeviceSize>(device.limits().minStorageBufferOffsetAlignment, 16);
    return static_cast<std::uint32_t>((sizeof(shared::BlurCounts) + align - 1) / align * align);
}

} // namespace

MomentMaps::MomentMaps(Device& device, const ResolvedOptions& options, const MapStorage& storage, LayerPlacer& placer,
                       std::uint32_t slots, VkPipelineCache cache)
    : device_(checkedDevice(device, options, storage)), options_(options), storage_(storage), placer_(placer),
      slots_(slots), counts_stride_(alignedCounts(device)),
      layers_per_map_(imageLayersPerMap(options.filter(), options.moments())), layout_(device, cache),
      mips_(layout_, pack::filterConstants(options)), kept_(device)
{
    const MomentOptions& o = options.moments();
    images_.kernel =
        HostBuffer(device, sizeof(shared::BlurKernel), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "shadow filter buffers");
    if (blurRadius(o) > 0) {
        blur_.emplace(layout_, options, storage.colour);
        *static_cast<shared::BlurKernel*>(images_.kernel.data()) = pack::blurKernel(o);
    } else {
        moments_.emplace(layout_, options);
    }
    images_.counts = HostBuffer(device, VkDeviceSize{counts_stride_} * slots_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                "shadow filter buffers");
    for (std::uint32_t slot = 0; slot < slots_; ++slot) {
        counts(slot) = {};
    }
}

MomentMaps::Need MomentMaps::needOf(const Plan& plan, std::uint32_t options)
{
    const MapPages& atlas = plan.pages[options];
    Need need;
    need.atlas = {std::max(atlas.width, 1U), std::max(atlas.height, 1U), std::max(atlas.layers, 1U)};
    for (const View& view : plan.views) {
        if (optionsIndexOf(plan, view) == options) {
            need.tile.width = std::max(need.tile.width, view.place.tile.width);
            need.tile.height = std::max(need.tile.height, view.place.tile.height);
        }
    }
    need.kept_layers = atlas.kept_layers;
    return need;
}

namespace {

bool covers(const Image& image, VkExtent2D extent, std::uint32_t layers)
{
    const ImageInfo& have = image.info();
    return image && have.extent.width >= extent.width && have.extent.height >= extent.height && have.layers >= layers;
}

constexpr VkImageUsageFlags kColour =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;

} // namespace

bool MomentMaps::growMaps(const MapPages& atlas)
{
    bool lost = false;
    const ImageInfo& have = images_.maps.info();
    ImageInfo info;
    info.format = storage_.colour;
    info.extent = {std::max(atlas.width, have.extent.width), std::max(atlas.height, have.extent.height)};
    info.layers = atlas.layers * layers_per_map_;
    if (images_.maps) {
        info.layers = std::max(info.layers, have.layers);
    }
    info.usage = kColour | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.purpose = "shadow maps";
    info.levels = pack::mipLevels(options_, info.extent.width, info.extent.height);
    Image larger(device_, info);
    if (images_.maps) {
        const bool has_levels = have.levels >= info.levels;
        outgrown_.take(device_, std::move(images_.maps), std::vector(have.layers, layout_of_maps_));
        if (!has_levels) { // the coarsest are nowhere to be had
            outgrown_.drop();
            lost = true;
        }
    }
    images_.maps = std::move(larger);
    layout_of_maps_ = VK_IMAGE_LAYOUT_UNDEFINED;
    clear_maps_ = true;
    return lost;
}

/// Grows the images that maps are made in, one after the other, to the size of the largest.
void MomentMaps::growWorking(VkExtent2D tile)
{
    if (images_.depth) {
        const VkExtent2D have = images_.depth.info().extent;
        tile = {std::max(tile.width, have.width), std::max(tile.height, have.height)};
    }
    ImageInfo depth;
    depth.format = storage_.depth;
    depth.extent = tile;
    depth.usage =
        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    depth.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    depth.purpose = "shadow map depth";
    depth.samples = samples();
    device_.retire(std::move(images_.depth));
    device_.retire(std::move(images_.scratch));
    device_.retire(std::move(images_.blocks));
    images_.depth = Image(device_, depth);
    if (blur_) {
        ImageInfo scratch;
        scratch.format = storage_.colour;
        images_.strips = pack::stripsOf(tile.width, layers_per_map_, device_.limits().maxImageArrayLayers);
        scratch.extent = {images_.strips.width, tile.height};
        scratch.layers = images_.strips.count * layers_per_map_;
        scratch.usage = kColour | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        scratch.purpose = "shadow blur";
        images_.scratch = Image(device_, scratch);
        clear_scratch_ = true;
    }
    const VkDeviceSize blocks = VkDeviceSize{pack::groupsOf(tile.width, shared::kBlockTexels)} *
                                pack::groupsOf(tile.height, shared::kBlockTexels);
    images_.blocks =
        DeviceBuffer(device_, 4 * blocks, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     "shadow filter buffers");
}

void MomentMaps::makeSets()
{
    images_.depth_layers = placer_.buffer();
    placer_.setDepth(images_.depth.layer(0));
    layout_.reset((blur_ ? BlurPass::kSets : MomentPass::kSets) + MipPass::sets(images_.maps.info().levels));
    if (blur_) {
        blur_->makeSets(images_);
    } else {
        moments_->makeSets(images_);
    }
    mips_.makeSets(images_);
}

MapRecorder::Prepared MomentMaps::prepare(const Plan& plan, std::uint32_t options)
{
    outgrown_.letGo();
    kept_.letGo();
    const Need need = needOf(plan, options);
    const bool grows_maps =
        !covers(images_.maps, {need.atlas.width, need.atlas.height}, need.atlas.layers * layers_per_map_);
    const bool grows_working = !images_.blocks || !covers(images_.depth, need.tile, 1);
    ready_ = !placer_.prepare(plan) && ready_ && !grows_maps && !grows_working;
    Prepared prepared;
    if (grows_maps) {
        prepared.lost = growMaps(need.atlas);
    }
    if (grows_working) {
        growWorking(need.tile);
    }
    if (!kept_.covers(images_.maps.info().extent, need.kept_layers)) {
        kept_.grow(storage_.depth, samples(), images_.maps.info().extent, need.kept_layers);
    }
    if (!ready_) {
        makeSets();
        ready_ = true;
        prepared.changed = true;
    }
    return prepared;
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
        // The last writer: the pass of the mip levels, or one that waited for itself already.
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
    fillNewImages(commands);
    if (layout_of_maps_ != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
        toLayout(commands, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
}

namespace {

void clearToZeros(const Device& device, VkCommandBuffer commands, const Image& image)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    barrier.new_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    recordBarrier(device, commands, barrier);
    const VkClearColorValue zeros{};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                      VK_REMAINING_ARRAY_LAYERS};
    device.vk.CmdClearColorImage(commands, image.image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &zeros, 1, &all);
}

/// After it was written by copies or clears.
void waitForTransfer(const Device& device, VkCommandBuffer commands, const Image& image, VkImageLayout to)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.new_layout = to;
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                            VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                            VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                            VK_ACCESS_2_TRANSFER_WRITE_BIT;
    recordBarrier(device, commands, barrier);
}

} // namespace

// A filtered read at the edge of a tile or of a block touches texels beside it with weight 0. New memory may hold NaN
// there, and 0 times that is not 0.
void MomentMaps::fillNewImages(VkCommandBuffer commands)
{
    placer_.copyOutgrown(commands);
    kept_.copyOutgrown(commands);
    if (clear_scratch_) {
        clearToZeros(device_, commands, images_.scratch);
        waitForTransfer(device_, commands, images_.scratch, VK_IMAGE_LAYOUT_GENERAL);
        clear_scratch_ = false;
    }
    if (clear_maps_) {
        clearToZeros(device_, commands, images_.maps);
        if (outgrown_) {
            waitForTransfer(device_, commands, images_.maps, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
            outgrown_.copyTo(commands, images_.maps, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        }
        waitForTransfer(device_, commands, images_.maps, VK_IMAGE_LAYOUT_GENERAL);
        layout_of_maps_ = VK_IMAGE_LAYOUT_GENERAL;
        clear_maps_ = false;
    }
}

void MomentMaps::record(const MapJob& job)
{
    assert(job.slot < slots_);
    const VkCommandBuffer commands = job.commands;
    counts(job.slot) = {}; // the GPU has finished with the slot
    fillNewImages(commands);
    bool drawn = false;
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (!job.of(i).draw) {
            continue;
        }
        drawn = true;
        if (layout_of_maps_ != VK_IMAGE_LAYOUT_GENERAL) {
            toLayout(commands, VK_IMAGE_LAYOUT_GENERAL);
        }
        {
            const Timed timed(job.profiler, commands, "shadow maps");
            recordDepth(job, i);
        }
        const Timed timed(job.profiler, commands, "shadow filter");
        recordFilter(job, i);
    }
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

void MomentMaps::recordDepth(const MapJob& job, std::uint32_t index)
{
    const VkCommandBuffer commands = job.commands;
    const Plan& plan = job.plan;
    const View& view = plan.views[index];
    assert(view.place.tile.x + view.place.tile.width <= images_.maps.info().extent.width &&
           view.place.tile.y + view.place.tile.height <= images_.maps.info().extent.height);
    beginViewLabel(device_, commands, plan, index);
    const Tile tile{0, 0, 0, view.place.tile.width, view.place.tile.height}; // in the working image
    ImageBarrier barrier;
    barrier.image = images_.depth.image();
    barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    if (view.contents.kept_layer != kNoIndex) {
        if (job.of(index).draw_kept) {
            kept_.draw(job, index);
        }
        kept_.restore(commands, view, images_.depth);
        beginDepthRendering(device_, commands, tile, images_.depth.layer(0), VK_ATTACHMENT_LOAD_OP_LOAD);
        drawView(job, index, pack::CasterShare::moving, 0);
    } else {
        barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL; // the last view's contents are not needed
        barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.target_stages = kDepthStages;
        barrier.target_access = kDepthAccess;
        recordBarrier(device_, commands, barrier);
        beginDepthRendering(device_, commands, tile, images_.depth.layer(0), VK_ATTACHMENT_LOAD_OP_CLEAR);
        drawView(job, index, pack::CasterShare::all, 0);
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

void MomentMaps::recordFilter(const MapJob& job, std::uint32_t index)
{
    const VkCommandBuffer commands = job.commands;
    const Plan& plan = job.plan;
    const View& view = plan.views[index];
    FilterStep step;
    step.commands = commands;
    step.tile = view.place.tile;
    step.first_layer = view.place.tile.layer * layers_per_map_;
    step.image_layers = layers_per_map_;
    step.strips = images_.strips;
    step.depth_slot = placer_.slotOf(plan, index);
    step.near_over_far = pack::nearOverFar(view, view.projection.metric);
    step.counts_offset = job.slot * counts_stride_;

    placer_.record(commands, plan, index);
    if (blur_) {
        blur_->record(step, images_);
    } else {
        moments_->record(step);
        waitForShaders(device_, commands);
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
