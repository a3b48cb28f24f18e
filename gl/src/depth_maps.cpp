// SPDX-License-Identifier: Apache-2.0
#include "depth_maps.h"

#include <algorithm>

namespace gnomon::gl {

DepthMaps::DepthMaps(const Context& context, Programs& programs, const ResolvedOptions& options)
    : context_(context), storage_(mapStorage(options.format())), target_(context)
{
    if (options.traits().integrates_light) {
        blocks_.emplace(context, programs);
    }
}

MapRecorder::Prepared DepthMaps::prepare(const Plan& plan, std::uint32_t options)
{
    const MapPages& pages = plan.pages[options];
    const glm::uvec2 size(std::max(pages.width, 1U), std::max(pages.height, 1U));
    Prepared prepared;
    prepared.changed = growImage(context_, maps_, {storage_.mapFormat(), size, std::max(pages.layers, 1U)});
    const glm::uvec2 extent = maps_.info().size;
    if (!storage_.depthOnly()) {
        (void)growImage(context_, depth_, {storage_.depth, extent, 1});
    }
    if (pages.kept_layers > 0) {
        (void)growImage(context_, kept_depths_, {storage_.depth, extent, pages.kept_layers});
        if (!storage_.depthOnly()) {
            (void)growImage(context_, kept_colours_, {storage_.colour, extent, pages.kept_layers});
        }
    }
    if (blocks_ && prepared.changed) {
        blocks_->setMaps(maps_);
    }
    return prepared;
}

bool DepthMaps::covers(const Plan&, const View& view) const
{
    const Tile& tile = view.place.tile;
    const std::uint32_t kept = view.contents.kept_layer;
    return maps_.covers({tile.x + tile.width, tile.y + tile.height}, tile.layer + 1) &&
           (kept == kNoIndex || kept_depths_.covers(maps_.info().size, kept + 1));
}

void DepthMaps::drawKept(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const std::uint32_t layer = view.contents.kept_layer;
    target_.bind(storage_.depthOnly() ? nullptr : &kept_colours_, layer, &kept_depths_, layer);
    setViewport(context_, view.place.tile);
    setScissor(context_, view.place.tile);
    target_.clearDepth();
    if (!storage_.depthOnly()) {
        target_.clearColour(1.0F);
    }
    drawCasters(context_, job, index, pack::CasterShare::still);
}

void DepthMaps::restore(const View& view, const Tile& area)
{
    Tile from = area;
    from.layer = view.contents.kept_layer;
    Tile to = area;
    if (storage_.depthOnly()) {
        copyTexels(context_, kept_depths_, from, maps_, to);
        return;
    }
    copyTexels(context_, kept_colours_, from, maps_, to);
    to.layer = 0;
    copyTexels(context_, kept_depths_, from, depth_, to);
}

void DepthMaps::drawMap(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const bool restores = view.contents.kept_layer != kNoIndex && view.place.part == TexelPart::whole;
    const Tile area = pack::redrawnPart(view, job.of(index).whole || !restores);
    if (restores) {
        restore(view, area);
    }
    if (storage_.depthOnly()) {
        target_.bind(nullptr, 0, &maps_, area.layer);
    } else {
        target_.bind(&maps_, area.layer, &depth_, 0);
    }
    setViewport(context_, view.place.tile);
    setScissor(context_, area);
    const unsigned channels = channelsOf(storage_.colour, view.place.part);
    const auto writes = [&](unsigned channel) {
        return static_cast<GLboolean>((channels >> channel & 1U) != 0 ? GL_TRUE : GL_FALSE);
    };
    context_.gl.ColorMaski(0, writes(0), writes(1), writes(2), writes(3));
    if (!restores) {
        target_.clearDepth();
        if (!storage_.depthOnly()) {
            target_.clearColour(1.0F);
        }
    }
    drawCasters(context_, job, index, restores ? pack::CasterShare::moving : pack::CasterShare::all);
    context_.gl.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void DepthMaps::draw(const MapJob& job)
{
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (job.of(i).draw_kept && job.plan.views[i].place.part == TexelPart::whole) {
            drawKept(job, i);
        }
    }
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (job.of(i).draw) {
            drawMap(job, i);
        }
    }
    if (blocks_) {
        blocks_->draw(job, maps_);
    }
}

} // namespace gnomon::gl
