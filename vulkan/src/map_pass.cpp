// SPDX-License-Identifier: Apache-2.0
#include "map_pass.h"

#include "barriers.h"
#include "classics.h"
#include "depth_blocks.h"
#include "draw_view.h"
#include "timed.h"

#include <gnomon/pack/map_attachments.h>
#include <gnomon/plan_views.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

bool sharesTexels(const Plan& plan, std::uint32_t options)
{
    return std::any_of(plan.views.begin(), plan.views.end(), [&](const View& view) {
        return optionsIndexOf(plan, view) == options && view.place.part != TexelPart::whole;
    });
}

bool mayStep(const ResolvedOptions& options)
{
    const Motion motion = options.technique().motion;
    return motion != Motion::free && motion != Motion::snap;
}

/// Maps of a sun that moves in steps are kept unless the options say otherwise.
bool mayKeepStill(const ResolvedOptions& options)
{
    const KeepStill keep = options.asked().keep_still;
    return keep == KeepStill::always || (keep == KeepStill::automatic && mayStep(options));
}

} // namespace

DepthMaps::DepthMaps(Device& device, const MapStorage& storage, const ResolvedOptions& options, VkPipelineCache cache,
                     const Classics* classics)
    : device_(device), storage_(storage), clear_(pack::mapAttachments(options, true).clear_colour), cache_(cache),
      classics_(classics)
{
    if (options.traits().integrates_light) {
        step_ = std::make_unique<DepthBlocks>(device, cache);
    } else if (options.hasSmoothies()) {
        step_ = classics_->makeSmoothies(device, options, cache);
    }
}

void DepthMaps::makeMaps(const MapPages& size)
{
    for (Layers& layers : layers_) {
        device_.retire(std::move(layers.view));
    }
    layers_.clear();
    const VkImageUsageFlags attachment =
        storage_.depthOnly() ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    maps_.grow(device_, {storage_.mapFormat(),
                         {size.width, size.height},
                         size.layers,
                         attachment | VK_IMAGE_USAGE_SAMPLED_BIT | kCopiedUsage,
                         storage_.aspect(),
                         "shadow maps"});
    const VkExtent2D extent = maps_.image().info().extent;
    if (!storage_.depthOnly()) {
        device_.retire(std::move(depth_));
        depth_ = Image(device_, {storage_.depth, extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT, "shadow map depth"});
    }
    if (step_) {
        step_->setMaps(maps_.image());
    }
}

void DepthMaps::warmUp(const ResolvedOptions& options)
{
    if (isDrawnTwice(options)) {
        painter_ = classics_->makeMidpoints(device_, storage_, cache_);
        return; // and then keeps nothing, and shares no texels
    }
    const bool shares_texels = options.paired_maps() && mayStep(options);
    if (!mayKeepStill(options) && !shares_texels) {
        return;
    }
    restorer_.emplace(device_, storage_, cache_);
    using Source = MapRestorer::Source;
    restorer_->ensure(TexelPart::whole, Source::depths);
    if (options.paired_maps()) {
        restorer_->ensure(TexelPart::first, Source::colours);
        restorer_->ensure(TexelPart::first, Source::depths); // for lamps beside the sun
    }
    if (shares_texels) {
        restorer_->ensure(TexelPart::second, Source::colours);
    }
}

MapRecorder::Prepared DepthMaps::prepare(const Plan& plan, std::uint32_t options)
{
    const MapPages& pages = plan.pages[options];
    const MapPages need{std::max(pages.width, 1U), std::max(pages.height, 1U), std::max(pages.layers, 1U)};
    for (LayeredTarget* const target : {&maps_, &kept_depths_, &kept_colours_}) {
        target->letGo();
    }
    Prepared prepared;
    if (!maps_.covers({need.width, need.height}, need.layers)) {
        makeMaps(need);
        prepared.changed = true;
        prepared.lost = step_ && step_->needsDrawnMaps();
    }
    if (!restorer_ && (pages.kept_layers > 0 || sharesTexels(plan, options))) {
        restorer_.emplace(device_, storage_, cache_);
    }
    for (const View& view : plan.views) {
        if (restorer_ && optionsIndexOf(plan, view) == options) {
            restorer_->ensure(view.place.part, sourceFor(view));
        }
    }
    prepared.changed = prepareKept(plan, options) || prepared.changed;
    if (isDrawnTwice((*plan.options)[options])) {
        if (!painter_) {
            painter_ = classics_->makeMidpoints(device_, storage_, cache_);
        }
        painter_->cover(maps_.image().info().extent);
    }
    prepareTogether(plan, options);
    return prepared;
}

const DepthMaps::Layers* DepthMaps::layersFrom(std::uint32_t first) const
{
    const auto found =
        std::find_if(layers_.begin(), layers_.end(), [&](const Layers& one) { return one.first == first; });
    return found != layers_.end() ? &*found : nullptr;
}

/// Makes the targets of passes of several views: an image view of the layers from each layer where such a pass may
/// begin, whichever views are drawn, and as many layers of depth.
void DepthMaps::prepareTogether(const Plan& plan, std::uint32_t options)
{
    std::uint32_t most = 1;
    for (std::uint32_t i = 0; i < plan.views.size();) {
        const bool together = optionsIndexOf(plan, plan.views[i]) == options && isDrawnTogether(plan, i);
        const std::uint32_t count = together ? viewsTogether(plan, i, true) : 1;
        for (std::uint32_t rest = count; rest > 1; --rest) {
            const std::uint32_t first = plan.views[i].place.tile.layer + count - rest;
            const Layers* const had = layersFrom(first);
            if (had == nullptr || had->count < rest) {
                std::erase_if(layers_, [&](Layers& one) {
                    const bool replaced = one.first == first;
                    if (replaced) {
                        device_.retire(std::move(one.view));
                    }
                    return replaced;
                });
                layers_.push_back({first, rest, maps_.image().range(device_, first, rest)});
            }
        }
        most = std::max(most, count);
        i += count;
    }
    const bool layered = (*plan.options)[options].cascades().pass == CascadePass::layered;
    const bool drops = !layered && depth_ && depth_.info().layers > 1;
    if (depth_ && (depth_.info().layers < most || drops)) {
        ImageInfo info = depth_.info();
        info.layers = most;
        device_.retire(std::move(depth_));
        depth_ = Image(device_, info);
    }
}

DepthMaps::Target DepthMaps::mapTarget(const View& view, const pack::ViewWork& work) const
{
    const VkRect2D area = redrawnArea(view, work.whole);
    const VkImageView layer = maps_.image().layer(view.place.tile.layer);
    if (storage_.depthOnly()) {
        return {VK_NULL_HANDLE, layer, true, true, area, 1};
    }
    return {layer, depth_.layer(0), view.place.part == TexelPart::whole, false, area, 1};
}

/// The target of `count` views with this tile in consecutive layers.
DepthMaps::Target DepthMaps::targetOf(const Tile& tile, std::uint32_t count) const
{
    const Layers* const found = layersFrom(tile.layer);
    assert(found != nullptr && found->count >= count);
    if (storage_.depthOnly()) {
        return {VK_NULL_HANDLE, found->view.get(), true, true, areaOf(tile), count};
    }
    return {found->view.get(), depth_.view(), true, false, areaOf(tile), count};
}

void DepthMaps::beginRendering(VkCommandBuffer commands, const Tile& tile, const Target& target)
{
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = target.depth;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = target.keeps_depth ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.clearValue.depthStencil = {1.0F, 0};

    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.colour;
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = target.clears_colour ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color = {{clear_, clear_, clear_, clear_}};

    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = target.area;
    info.layerCount = target.layer_count;
    info.colorAttachmentCount = storage_.depthOnly() ? 0U : 1U;
    info.pColorAttachments = storage_.depthOnly() ? nullptr : &colour;
    info.pDepthAttachment = &depth;
    device_.vk.CmdBeginRendering(commands, &info);

    setViewport(device_, commands, tile);
    device_.vk.CmdSetScissor(commands, 0, 1, &target.area);
}

// The views' maps in a colour format all use the one image of depths.
void DepthMaps::waitForDepth(BarrierBatch& barriers)
{
    ImageBarrier barrier;
    barrier.image = depth_.image();
    barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    barrier.layer_count = depth_.info().layers;
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = kDepthStages;
    barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    barriers.add(barrier);
}

void DepthMaps::drawMaps(const MapJob& job)
{
    const std::span<const View> views = job.plan.views;
    BarrierBatch before(device_, job.commands);
    for (std::uint32_t layer = 0; layer < maps_.image().info().layers; ++layer) {
        for (std::uint32_t i = 0; i < views.size(); ++i) {
            if (job.of(i).draw && views[i].place.tile.layer == layer) {
                maps_.toAttachment(before, layer);
                break;
            }
        }
    }
    before.record();
    for (std::uint32_t i = 0; i < views.size();) {
        const std::uint32_t count = drawnTogether(job.plan, job.work, i);
        if (count > 1 && job.of(i).draw) {
            drawTogether(job, i, count);
        } else if (job.of(i).draw) {
            drawMap(job, i);
        }
        i += count;
    }
}

void DepthMaps::drawMap(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const VkCommandBuffer commands = job.commands;
    assert(view.place.tile.x + view.place.tile.width <= maps_.image().info().extent.width &&
           view.place.tile.y + view.place.tile.height <= maps_.image().info().extent.height);
    beginViewLabel(device_, commands, job.plan, index);
    if (isDrawnTwice(optionsOf(job.plan, view))) {
        painter_->drawCasters(job, index);
        beginRendering(commands, view.place.tile, mapTarget(view, job.of(index)));
        painter_->drawMap(commands);
        device_.vk.CmdEndRendering(commands);
        device_.endLabel(commands);
        return;
    }
    BarrierBatch barriers(device_, commands);
    if (!storage_.depthOnly()) {
        waitForDepth(barriers);
    }
    if (view.place.part != TexelPart::whole) { // the other part of the same texels may just have been drawn
        maps_.waitForDrawing(barriers, view.place.tile.layer);
    }
    barriers.record();
    beginRendering(commands, view.place.tile, mapTarget(view, job.of(index)));
    if (view.contents.kept_layer != kNoIndex) {
        restorer_->restore(commands, view.place.part, sourceFor(view), view.contents.kept_layer);
    } else if (view.place.part != TexelPart::whole) {
        restorer_->clear(commands, view.place.part);
    }
    drawView(job, index, view.contents.kept_layer != kNoIndex ? pack::CasterShare::moving : pack::CasterShare::all,
             colourMaskOf(storage_.colour, view.place.part));
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void DepthMaps::drawTogether(const MapJob& job, std::uint32_t first, std::uint32_t count)
{
    const VkCommandBuffer commands = job.commands;
    beginViewLabel(device_, commands, job.plan, first);
    if (!storage_.depthOnly()) {
        BarrierBatch barriers(device_, commands);
        waitForDepth(barriers);
    }
    const Tile& tile = job.plan.views[first].place.tile;
    beginRendering(commands, tile, targetOf(tile, count));
    MapPass pass = passOf(job, first, colourMaskOf(storage_.colour, TexelPart::whole));
    pass.view_count = count;
    pass.casters = pass.castersOf(0);
    job.draw(pass);
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void DepthMaps::record(const MapJob& job)
{
    Profiler* const profiler = job.profilerOfWork();
    {
        const Timed timed(profiler, job.commands, "shadow maps");
        copyOutgrown(job.commands);
        drawKept(job);
        drawMaps(job);
        makeReadable(job.commands);
        if (step_ && step_->passName() == nullptr) {
            step_->record(job);
        }
    }
    if (step_ && step_->passName() != nullptr) {
        const Timed timed(profiler, job.commands, step_->passName());
        step_->record(job);
    }
}

void DepthMaps::copyOutgrown(VkCommandBuffer commands)
{
    for (LayeredTarget* const target : {&maps_, &kept_depths_, &kept_colours_}) {
        target->copyOutgrown(commands);
    }
}

void DepthMaps::makeReadable(VkCommandBuffer commands)
{
    copyOutgrown(commands);
    BarrierBatch barriers(device_, commands);
    maps_.makeReadable(barriers);
}

} // namespace gnomon::vulkan
