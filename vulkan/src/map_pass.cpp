// SPDX-License-Identifier: Apache-2.0
#include "map_pass.h"

#include "draw_view.h"
#include "timed.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

bool isKept(const View& view)
{
    return view.kept_layer != kNoIndex;
}

bool sharesTexels(const Plan& plan)
{
    return std::any_of(plan.views.begin(), plan.views.end(),
                       [](const View& view) { return view.part != TexelPart::whole; });
}

} // namespace

DepthMaps::DepthMaps(Device& device, const ShadowRendererOptions& options, const MapStorage& storage)
    : device_(device), storage_(storage), cache_(options.pipeline_cache)
{
}

void DepthMaps::makeMaps(const MapPages& size)
{
    // Free the old images first, so that growing does not need room for both.
    layers_.clear();
    maps_ = {};
    depth_ = {};
    kept_colours_ = {};
    kept_depths_ = {};
    const VkExtent2D extent{size.width, size.height};
    const VkImageUsageFlags attachment =
        storage_.depthOnly() ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    maps_ = LayeredTarget(device_, {storage_.mapFormat(), extent, size.layers,
                                    attachment | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                    storage_.aspect(), "shadow maps"});
    if (!storage_.depthOnly()) {
        depth_ = Image(device_, {storage_.depth, extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT, "shadow map depth"});
    }
}

void DepthMaps::makeKept(std::uint32_t layers)
{
    kept_colours_ = {};
    kept_depths_ = {};
    const VkExtent2D extent = maps_.image().info().extent;
    kept_depths_ = LayeredTarget(device_, {storage_.depth, extent, layers,
                                           VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                           VK_IMAGE_ASPECT_DEPTH_BIT, "kept shadow maps"});
    if (!storage_.depthOnly()) {
        kept_colours_ = LayeredTarget(device_, {storage_.colour, extent, layers,
                                                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                                VK_IMAGE_ASPECT_COLOR_BIT, "kept shadow maps"});
    }
    restorer_->setKept(kept_depths_.image().view(), kept_colours_.image().view());
}

bool DepthMaps::prepare(const Plan& plan)
{
    const MapPages& atlas = plan.pages[0];
    const MapPages need{std::max(atlas.width, 1U), std::max(atlas.height, 1U), std::max(atlas.layers, 1U)};
    bool changed = false;
    if (!maps_.covers({need.width, need.height}, need.layers)) {
        makeMaps(need);
        changed = true;
    }
    if (!restorer_ && (plan.pages[0].kept_layers > 0 || sharesTexels(plan))) {
        restorer_.emplace(device_, storage_, cache_);
    }
    if (plan.pages[0].kept_layers > 0 && !kept_depths_.covers(maps_.image().info().extent, plan.pages[0].kept_layers)) {
        makeKept(plan.pages[0].kept_layers);
        changed = true;
    }
    redraw_all_ = redraw_all_ || changed;
    prepareTogether(plan);
    return changed;
}

std::uint32_t DepthMaps::together(const Plan& plan, std::uint32_t first, bool all) const
{
    return pass_ == CascadePass::layered ? viewsTogether(plan, first, all) : 1;
}

const DepthMaps::Layers* DepthMaps::layersFrom(std::uint32_t first) const
{
    const auto found =
        std::find_if(layers_.begin(), layers_.end(), [&](const Layers& one) { return one.first == first; });
    return found != layers_.end() ? &*found : nullptr;
}

/// What passes of several views draw to: an image view of the layers from wherever one may begin, whichever views there
/// are to be drawn, and as many layers of depth.
void DepthMaps::prepareTogether(const Plan& plan)
{
    std::uint32_t most = 1;
    for (std::uint32_t i = 0; i < plan.views.size();) {
        const std::uint32_t count = together(plan, i, true);
        for (std::uint32_t rest = count; rest > 1; --rest) {
            const std::uint32_t first = plan.views[i].tile.layer + count - rest;
            const Layers* const had = layersFrom(first);
            if (had == nullptr || had->count < rest) {
                std::erase_if(layers_, [&](const Layers& one) { return one.first == first; });
                layers_.push_back({first, rest, maps_.image().range(device_, first, rest)});
            }
        }
        most = std::max(most, count);
        i += count;
    }
    const bool drops = pass_ != CascadePass::layered && depth_ && depth_.info().layers > 1;
    if (depth_ && (depth_.info().layers < most || drops)) {
        ImageInfo info = depth_.info();
        info.layers = most;
        depth_ = {};
        depth_ = Image(device_, info);
    }
}

MapPassFormats DepthMaps::formats(bool orthographic) const
{
    return {storage_.colour, storage_.depth, VK_SAMPLE_COUNT_1_BIT, storage_.depthOnly() && !orthographic};
}

DepthMaps::Target DepthMaps::mapTarget(const View& view) const
{
    const VkRect2D area = isKept(view) ? redrawnArea(view, redraw_all_) : areaOf(view.tile);
    const VkImageView layer = maps_.image().layer(view.tile.layer);
    if (storage_.depthOnly()) {
        return {VK_NULL_HANDLE, layer, true, true, area, 1};
    }
    return {layer, depth_.layer(0), view.part == TexelPart::whole, false, area, 1};
}

/// Of `count` views with this tile in consecutive layers.
DepthMaps::Target DepthMaps::targetOf(const Tile& tile, std::uint32_t count) const
{
    const Layers* const found = layersFrom(tile.layer);
    assert(found != nullptr && found->count >= count);
    if (storage_.depthOnly()) {
        return {VK_NULL_HANDLE, found->view.get(), true, true, areaOf(tile), count};
    }
    return {found->view.get(), depth_.view(), true, false, areaOf(tile), count};
}

DepthMaps::Target DepthMaps::keptTarget(const View& view) const
{
    return {storage_.depthOnly() ? VkImageView{VK_NULL_HANDLE} : kept_colours_.image().layer(view.kept_layer),
            kept_depths_.image().layer(view.kept_layer),
            true,
            true,
            areaOf(view.tile),
            1};
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
    colour.clearValue.color = {{1.0F, 1.0F, 1.0F, 1.0F}};

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
void DepthMaps::waitForDepth(VkCommandBuffer commands)
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
    recordBarrier(device_, commands, barrier);
}

void DepthMaps::drawKept(VkCommandBuffer commands, const Plan& plan, const DrawCasters& draw)
{
    const auto is_drawn = [&](const View& view) {
        return isKept(view) && (view.redraw_kept || redraw_all_);
    };
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        if (!is_drawn(view)) {
            continue;
        }
        beginViewLabel(device_, commands, plan, i);
        kept_depths_.toAttachment(commands, view.kept_layer);
        if (kept_colours_) {
            kept_colours_.toAttachment(commands, view.kept_layer);
        }
        beginRendering(commands, view.tile, keptTarget(view));
        drawView(commands, plan, i, CasterShare::still, colourMaskOf(storage_.colour, view.part), draw);
        device_.vk.CmdEndRendering(commands);
        kept_depths_.toReadable(commands, view.kept_layer);
        if (kept_colours_) {
            kept_colours_.toReadable(commands, view.kept_layer);
        }
        device_.endLabel(commands);
    }
    // What restores a map names the whole image, with the layers of maps that nobody has needed so far.
    kept_depths_.makeReadable(commands);
    kept_colours_.makeReadable(commands);
}

void DepthMaps::drawMaps(VkCommandBuffer commands, const Plan& plan, const DrawCasters& draw)
{
    const auto is_drawn = [&](const View& view) {
        return redraw_all_ || (view.redraw && !(isKept(view) && !view.redraw_kept && view.dirty.empty()));
    };
    for (std::uint32_t layer = 0; layer < maps_.image().info().layers; ++layer) {
        if (std::any_of(plan.views.begin(), plan.views.end(),
                        [&](const View& view) { return is_drawn(view) && view.tile.layer == layer; })) {
            maps_.toAttachment(commands, layer);
        }
    }
    for (std::uint32_t i = 0; i < plan.views.size();) {
        const std::uint32_t count = together(plan, i, redraw_all_);
        if (count > 1) {
            drawTogether(commands, plan, i, count, draw);
        } else if (is_drawn(plan.views[i])) {
            drawMap(commands, plan, i, draw);
        }
        i += count;
    }
}

void DepthMaps::drawMap(VkCommandBuffer commands, const Plan& plan, std::uint32_t index, const DrawCasters& draw)
{
    const View& view = plan.views[index];
    assert(view.tile.x + view.tile.width <= maps_.image().info().extent.width &&
           view.tile.y + view.tile.height <= maps_.image().info().extent.height);
    beginViewLabel(device_, commands, plan, index);
    if (!storage_.depthOnly()) {
        waitForDepth(commands);
    }
    if (view.part != TexelPart::whole) { // the other part of the same texels may just have been drawn
        maps_.waitForDrawing(commands, view.tile.layer);
    }
    beginRendering(commands, view.tile, mapTarget(view));
    if (isKept(view)) {
        restorer_->restore(commands, view.part, view.kept_layer);
    } else if (view.part != TexelPart::whole) {
        restorer_->clear(commands, view.part);
    }
    drawView(commands, plan, index, isKept(view) ? CasterShare::moving : CasterShare::all,
             colourMaskOf(storage_.colour, view.part), draw);
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void DepthMaps::drawTogether(VkCommandBuffer commands, const Plan& plan, std::uint32_t first, std::uint32_t count,
                             const DrawCasters& draw)
{
    beginViewLabel(device_, commands, plan, first);
    if (!storage_.depthOnly()) {
        waitForDepth(commands);
    }
    const Tile& tile = plan.views[first].tile;
    beginRendering(commands, tile, targetOf(tile, count));
    MapPass pass = passOf(commands, plan, first, colourMaskOf(storage_.colour, TexelPart::whole));
    pass.view_count = count;
    pass.casters = pass.castersOf(0);
    draw(pass);
    device_.vk.CmdEndRendering(commands);
    device_.endLabel(commands);
}

void DepthMaps::record(VkCommandBuffer commands, [[maybe_unused]] std::uint32_t slot, const Plan& plan,
                       const DrawCasters& draw, Profiler* profiler)
{
    const Timed timed(profiler, commands, "shadow maps");
    drawKept(commands, plan, draw);
    drawMaps(commands, plan, draw);
    redraw_all_ = false;
    makeReadable(commands);
}

} // namespace gnomon::vulkan
