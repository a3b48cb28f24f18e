// SPDX-License-Identifier: Apache-2.0
#include "tint_maps.h"

#include "draw_view.h"
#include "timed.h"

#include <gnomon/error.h>
#include <gnomon/plan_views.h>
#include <gnomon/vulkan/classic_pass.h>

#include <algorithm>
#include <utility>

namespace gnomon::vulkan {
namespace {

// Every step of a product of a few panes is there, and depths as finely as in maps of d16. Half floats have 11 bits.
constexpr VkFormat kTintFormat = VK_FORMAT_R16G16B16A16_UNORM;
constexpr VkFormat kBlockerFormat = VK_FORMAT_D32_SFLOAT;

} // namespace

MapPassFormats blockerFormats(bool orthographic)
{
    return {.depth = kBlockerFormat, .write_frag_depth = !orthographic};
}

MapPassFormats tintFormats()
{
    return {.colour = kTintFormat, .depth = kBlockerFormat, .write_frag_depth = true, .blended = true};
}

void TintMaps::makeImages(const MapPages& pages, std::uint32_t layers)
{
    constexpr VkFormatFeatureFlags kNeeded =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    if ((device_.features(kTintFormat) & kNeeded) != kNeeded) {
        throw Error("make maps of blended casters", "the device cannot blend in R16G16B16A16_UNORM",
                    "leave ShadowRendererOptions::is_blended null");
    }
    tints_.grow(device_, {kTintFormat,
                          {pages.width, pages.height},
                          layers,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                          VK_IMAGE_ASPECT_COLOR_BIT,
                          "maps of tints"});
    device_.retire(std::move(depth_));
    depth_ =
        Image(device_, {kBlockerFormat, tints_.image().info().extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                        VK_IMAGE_ASPECT_DEPTH_BIT, "depth before blended casters"});
}

bool TintMaps::prepare(const Plan& plan, std::uint32_t options, const std::function<bool(std::uint32_t)>& is_blended)
{
    const bool was_in_use = std::exchange(in_use_, false);
    if (!is_blended || (*plan.options)[options].asked().translucent == Translucent::none) {
        return was_in_use;
    }
    tints_.letGo();
    // Two maps that share their texels have a layer each.
    const bool paired = (*plan.options)[options].paired_maps();
    places_.assign(plan.views.size(), 0);
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        if (optionsIndexOf(plan, view) == options &&
            std::ranges::any_of(pack::castersOf(plan, view, pack::CasterShare::all), is_blended)) {
            places_[i] = 1 + (paired ? 2 * view.place.tile.layer + (view.place.part == TexelPart::second ? 1U : 0U)
                                     : view.place.tile.layer);
            in_use_ = true;
        }
    }
    held_.resize(std::max<std::size_t>(held_.size(), plan.map_count), 0);
    const MapPages& pages = plan.pages[options];
    const std::uint32_t layers = pages.layers * (paired ? 2 : 1);
    const bool grows = in_use_ && !tints_.covers({pages.width, pages.height}, layers);
    if (grows) {
        makeImages(pages, layers);
    }
    return grows || in_use_ != was_in_use;
}

bool TintMaps::draws(const MapJob& job, std::uint32_t index) const
{
    const View& view = job.plan.views[index];
    const bool holds = view.contents.makes == 0 || held_[view.place.map.index] == view.contents.makes;
    return places_[index] != 0 && (job.of(index).draw || !holds);
}

bool TintMaps::record(const MapJob& job)
{
    if (!in_use_) {
        return false;
    }
    bool any = false;
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
        any = any || draws(job, i);
    }
    const Timed timed(any ? job.profiler : nullptr, job.commands, "maps of tints");
    tints_.copyOutgrown(job.commands);
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
        if (draws(job, i)) {
            draw(job, i);
            held_[job.plan.views[i].place.map.index] = job.plan.views[i].contents.makes;
        }
    }
    BarrierBatch after(device_, job.commands);
    tints_.makeReadable(after);
    return any;
}

void TintMaps::draw(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const std::uint32_t layer = places_[index] - 1;
    ImageBarrier depth;
    depth.image = depth_.image();
    depth.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    depth.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.source_stages = kDepthStages;
    depth.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    depth.target_stages = kDepthStages;
    depth.target_access = kDepthAccess;
    {
        BarrierBatch before(device_, job.commands);
        before.add(depth);
        tints_.toAttachment(before, layer);
    }
    beginViewLabel(device_, job.commands, job.plan, index);
    const ClassicPass bent{.formats = {.paraboloid = true}};
    MapPass pass = passOf(job, index, 0);
    pass.casters = pack::castersOf(job.plan, view, pack::CasterShare::all);
    pass.formats = blockerFormats(view.projection.orthographic);
    pass.classic = view.projection.paraboloid ? &bent : nullptr;
    beginRendering(job.commands, view.place.tile, VK_NULL_HANDLE);
    job.draw(pass);
    device_.vk.CmdEndRendering(job.commands);
    depth.old_layout = depth.new_layout;
    recordBarrier(device_, job.commands, depth);
    pass.formats = tintFormats();
    pass.colour_mask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    beginRendering(job.commands, view.place.tile, tints_.image().layer(layer));
    job.draw(pass);
    device_.vk.CmdEndRendering(job.commands);
    device_.endLabel(job.commands);
}

/// With a colour: of blended casters, tested against the depth that is there. Without: of what blocks.
void TintMaps::beginRendering(VkCommandBuffer commands, const Tile& tile, VkImageView colour_view)
{
    const bool keeps = colour_view != VK_NULL_HANDLE;
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = depth_.layer(0);
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = keeps ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = keeps ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
    depth.clearValue.depthStencil = {1.0F, 0};
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = colour_view;
    colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color = {{1.0F, 1.0F, 1.0F, 1.0F}};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = areaOf(tile);
    info.layerCount = 1;
    info.colorAttachmentCount = keeps ? 1U : 0U;
    info.pColorAttachments = keeps ? &colour : nullptr;
    info.pDepthAttachment = &depth;
    device_.vk.CmdBeginRendering(commands, &info);
    setViewport(device_, commands, tile);
}

} // namespace gnomon::vulkan
