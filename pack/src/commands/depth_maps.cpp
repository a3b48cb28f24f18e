// SPDX-License-Identifier: Apache-2.0
// Maps that are drawn and then read as they are. A view with a kept layer is drawn in two parts: what stands still into
// the kept layer, from which the map is restored where something moves, and what moves over that. Maps that share
// texels with another one are always drawn whole.
#include "commands/map_commands.h"

#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/map_attachments.h>
#include <gnomon/plan_views.h>

#include <algorithm>

namespace gnomon::pack {
namespace {

class DepthMaps final : public MapCommands {
public:
    DepthMaps(Recording& recording, const ResolvedOptions& options, std::uint32_t index)
        : recording_(recording), format_(options.format()), has_blocks_(options.traits().integrates_light),
          options_(index)
    {
    }

    Prepared prepare(const Plan& plan) override;
    void draw(const MapJob& job) override;
    [[nodiscard]] bool covers(const Plan& plan, const View& view) const override;

private:
    [[nodiscard]] ImageRef image(ImageName name) const { return {name, options_}; }
    [[nodiscard]] CommandTarget targetOf(const Tile& viewport, const Tile& scissor) const;
    void drawKept(const MapJob& job, std::uint32_t view);
    void restore(const View& view, const Tile& area);
    void drawMap(const MapJob& job, std::uint32_t view);
    void makeBlocks(const Tile& part);
    void drawBlocks(const MapJob& job);

    Recording& recording_;
    MapFormat format_;
    bool has_blocks_;      // the filter reads blocks of depths
    bool are_new_ = false; // no block is made yet
    std::uint32_t options_;
};

MapCommands::Prepared DepthMaps::prepare(const Plan& plan)
{
    const MapPages& pages = plan.pages[options_];
    const glm::uvec2 size(std::max(pages.width, 1U), std::max(pages.height, 1U));
    Prepared prepared;
    prepared.changed = recording_.grow(image(ImageName::maps), {format_, size, std::max(pages.layers, 1U)});
    const ImageShape maps = recording_.shapeOf(image(ImageName::maps));
    const MapFormat depth = depthFormatOf(format_);
    if (!isDepth(format_)) {
        (void)recording_.grow(image(ImageName::depths), {depth, maps.size_px, 1});
    }
    if (pages.kept_layers > 0) {
        (void)recording_.grow(image(ImageName::kept_depths), {depth, maps.size_px, pages.kept_layers});
        if (!isDepth(format_)) {
            (void)recording_.grow(image(ImageName::kept_colours), {format_, maps.size_px, pages.kept_layers});
        }
    }
    if (has_blocks_ && prepared.changed) {
        recording_.make(image(ImageName::blocks),
                        {{}, blocksExtent(maps.size_px), maps.layers, blockLevels(maps.size_px)});
        are_new_ = true;
    }
    return prepared;
}

bool DepthMaps::covers(const Plan&, const View& view) const
{
    const Tile& tile = view.place.tile;
    const std::uint32_t kept = view.contents.kept_layer;
    const ImageRef maps = image(ImageName::maps);
    return recording_.covers(maps, {tile.x + tile.width, tile.y + tile.height}, tile.layer + 1) &&
           (kept == kNoIndex ||
            recording_.covers(image(ImageName::kept_depths), recording_.shapeOf(maps).size_px, kept + 1));
}

/// To the maps.
CommandTarget DepthMaps::targetOf(const Tile& viewport, const Tile& scissor) const
{
    CommandTarget target;
    target.viewport = viewport;
    target.scissor = scissor;
    if (isDepth(format_)) {
        target.depth = image(ImageName::maps);
        target.depth_layer = scissor.layer;
    } else {
        target.colour = image(ImageName::maps);
        target.colour_layer = scissor.layer;
        target.depth = image(ImageName::depths);
    }
    return target;
}

void DepthMaps::drawKept(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    CommandTarget target = targetOf(view.place.tile, view.place.tile);
    target.depth = image(ImageName::kept_depths);
    target.depth_layer = view.contents.kept_layer;
    if (target.colour) {
        target.colour = image(ImageName::kept_colours);
        target.colour_layer = view.contents.kept_layer;
    }
    recording_.add(ClearTarget{target});
    recording_.add(DrawMapCasters{target, index, CasterShare::still});
}

void DepthMaps::restore(const View& view, const Tile& area)
{
    Tile from = area;
    from.layer = view.contents.kept_layer;
    if (isDepth(format_)) {
        recording_.add(CopyTexels{image(ImageName::kept_depths), from, image(ImageName::maps), area});
        return;
    }
    recording_.add(CopyTexels{image(ImageName::kept_colours), from, image(ImageName::maps), area});
    Tile to = area;
    to.layer = 0;
    recording_.add(CopyTexels{image(ImageName::kept_depths), from, image(ImageName::depths), to});
}

void DepthMaps::drawMap(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const bool restores = view.contents.kept_layer != kNoIndex && view.place.part == TexelPart::whole;
    const Tile area = redrawnPart(view, job.of(index).whole || !restores);
    CommandTarget target = targetOf(view.place.tile, area);
    target.channels = channelsOfPart(format_, view.place.part);
    if (restores) {
        restore(view, area);
    } else {
        recording_.add(ClearTarget{target});
    }
    recording_.add(DrawMapCasters{target, index, restores ? CasterShare::moving : CasterShare::all});
}

void DepthMaps::makeBlocks(const Tile& part)
{
    const ImageRef maps = image(ImageName::maps);
    const ImageRef blocks = image(ImageName::blocks);
    const std::uint32_t levels = recording_.shapeOf(blocks).levels;
    for (std::uint32_t i = 0; i < blockPassCount(levels); ++i) {
        const BlockPass pass = blockPass(i, recording_.shapeOf(maps).size_px, part);
        struct Push {
            std::array<std::int32_t, 4> first;
            std::array<std::int32_t, 4> last;
        };
        RunCompute run;
        run.module = i == 0 ? "depth_blocks_map.comp" : "depth_blocks.comp";
        run.push = recording_.words(Push{pass.first, pass.last});
        // A pass that makes the last level alone has no next one: the shader does not write it.
        run.bindings = recording_.bindings({i == 0 ? texture(0, maps) : storageImage(0, blocks, pass.first_level - 1),
                                            storageImage(1, blocks, pass.first_level),
                                            storageImage(2, blocks, std::min(pass.first_level + 1, levels - 1))});
        run.groups = {pass.groups_x, pass.groups_y, 1};
        recording_.add(run);
    }
}

void DepthMaps::drawBlocks(const MapJob& job)
{
    const ImageShape maps = recording_.shapeOf(image(ImageName::maps));
    for (std::uint32_t layer = 0; are_new_ && layer < maps.layers; ++layer) {
        makeBlocks({layer, 0, 0, maps.size_px.x, maps.size_px.y});
    }
    for (std::uint32_t i = 0; !are_new_ && i < job.plan.views.size(); ++i) {
        if (job.of(i).draw) {
            const View& view = job.plan.views[i];
            makeBlocks(redrawnPart(view, job.of(i).whole || view.place.part != TexelPart::whole));
        }
    }
    are_new_ = false;
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
    if (has_blocks_) {
        drawBlocks(job);
    }
}

} // namespace

ViewWork MapJob::of(std::uint32_t view) const
{
    return optionsIndexOf(plan, plan.views[view]) == options ? work[view] : ViewWork{};
}

MapFormat depthFormatOf(MapFormat format)
{
    return isDepth(format) ? format : MapFormat::d32f;
}

std::unique_ptr<MapCommands> makeMapCommands(Recording& recording, const RecorderTraits& traits,
                                             const ResolvedOptions& options, std::uint32_t index)
{
    if (options.filterable()) {
        return makeMomentMaps(recording, traits, options, index);
    }
    return std::make_unique<DepthMaps>(recording, options, index);
}

} // namespace gnomon::pack
