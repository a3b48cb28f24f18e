// SPDX-License-Identifier: Apache-2.0
// The part of DepthMaps for maps of still casters, which are kept apart.
#include "draw_view.h"
#include "map_pass.h"

#include <gnomon/plan_views.h>

#include <algorithm>

namespace gnomon::vulkan {

/// Depths can be restored from a map's own colours, where these are two maps of 16 bits a texel and the light is
/// parallel: then the rasteriser's depth is the metric.
bool DepthMaps::keepsDepth(const View& view) const
{
    const bool pairs =
        colourMaskOf(storage_.colour, TexelPart::first) != colourMaskOf(storage_.colour, TexelPart::whole);
    return !pairs || view.place.part == TexelPart::whole || !view.projection.orthographic;
}

MapRestorer::Source DepthMaps::sourceFor(const View& view) const
{
    return keepsDepth(view) ? MapRestorer::Source::depths : MapRestorer::Source::colours;
}

/// Returns whether there are new images.
bool DepthMaps::prepareKept(const Plan& plan, std::uint32_t options)
{
    const std::uint32_t layers = plan.pages[options].kept_layers;
    if (layers == 0) {
        return false;
    }
    const VkExtent2D extent = maps_.image().info().extent;
    const bool depths =
        kept_depths_ || storage_.depthOnly() ||
        std::any_of(plan.views.begin(), plan.views.end(), [&](const View& view) {
            return optionsIndexOf(plan, view) == options && view.contents.kept_layer != kNoIndex && keepsDepth(view);
        });
    const bool has_room = (!depths || kept_depths_.covers(extent, layers)) &&
                          (storage_.depthOnly() || kept_colours_.covers(extent, layers));
    if (!has_room) {
        makeKept(layers, depths);
    }
    return !has_room;
}

void DepthMaps::makeKept(std::uint32_t layers, bool depths)
{
    const VkExtent2D extent = maps_.image().info().extent;
    if (depths && !kept_depths_.covers(extent, layers)) {
        kept_depths_.grow(device_,
                          {storage_.depth, extent, layers,
                           VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | kCopiedUsage,
                           VK_IMAGE_ASPECT_DEPTH_BIT, "kept shadow maps"});
    }
    if (!storage_.depthOnly() && !kept_colours_.covers(extent, layers)) {
        kept_colours_.grow(device_, {storage_.colour, extent, layers,
                                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | kCopiedUsage,
                                     VK_IMAGE_ASPECT_COLOR_BIT, "kept shadow maps"});
    }
    restorer_->setKept(kept_depths_.image().view(), kept_colours_.image().view()); // an image that is none has none
}

DepthMaps::Target DepthMaps::keptTarget(const View& view) const
{
    const bool keeps_depth = keepsDepth(view);
    return {storage_.depthOnly() ? VkImageView{VK_NULL_HANDLE} : kept_colours_.image().layer(view.contents.kept_layer),
            keeps_depth ? kept_depths_.image().layer(view.contents.kept_layer) : depth_.layer(0),
            view.place.part == TexelPart::whole,
            keeps_depth,
            areaOf(view.place.tile),
            1};
}

void DepthMaps::drawKept(const MapJob& job)
{
    const std::span<const View> views = job.plan.views;
    BarrierBatch before(device_, job.commands);
    const auto isDrawnFirst = [&](std::uint32_t index) { // among views that share its layer
        return std::none_of(views.begin(), views.begin() + index, [&](const View& other) {
            const auto earlier = static_cast<std::uint32_t>(&other - views.data());
            return job.of(earlier).draw_kept && other.contents.kept_layer == views[index].contents.kept_layer;
        });
    };
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        if (job.of(i).draw_kept && isDrawnFirst(i)) {
            if (kept_depths_) {
                kept_depths_.toAttachment(before, views[i].contents.kept_layer);
            }
            if (kept_colours_) {
                kept_colours_.toAttachment(before, views[i].contents.kept_layer);
            }
        }
    }
    before.record();
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        if (job.of(i).draw_kept) {
            drawKept(job, i);
        }
    }
    // The restoring pass binds the whole image, with the layers of maps that nobody has needed so far.
    BarrierBatch after(device_, job.commands);
    kept_depths_.makeReadable(after);
    kept_colours_.makeReadable(after);
}

void DepthMaps::drawKept(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    beginViewLabel(device_, job.commands, job.plan, index);
    BarrierBatch barriers(device_, job.commands);
    if (!keepsDepth(view)) {
        waitForDepth(barriers);
    }
    if (view.place.part != TexelPart::whole) { // the other part of the same texels may just have been drawn
        kept_colours_.waitForDrawing(barriers, view.contents.kept_layer);
    }
    barriers.record();
    beginRendering(job.commands, view.place.tile, keptTarget(view));
    if (view.place.part != TexelPart::whole) {
        restorer_->clear(job.commands, view.place.part);
    }
    drawView(job, index, pack::CasterShare::still, colourMaskOf(storage_.colour, view.place.part));
    device_.vk.CmdEndRendering(job.commands);
    device_.endLabel(job.commands);
}

} // namespace gnomon::vulkan
