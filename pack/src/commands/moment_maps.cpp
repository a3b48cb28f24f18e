// SPDX-License-Identifier: Apache-2.0
// Filterable maps: casters are drawn as depths, which become the filter's stored values, blurred or not, and mip
// levels. Layers of lvsm are placed between. All of a tile is made, however little of it has changed.
#include "commands/map_commands.h"

#include <gnomon/pack/depth_layers.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/gpu_structs.h>
#include <gnomon/shared/layer_gaps.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace gnomon::pack {
namespace {

std::uint32_t sumsOf(const MomentOptions& options)
{
    return options.placement == LayerPlacement::gaps ? shared::kGapBins * shared::kGapColumns : shared::kDepthBins;
}

std::uint32_t walksOf(std::uint32_t texels)
{
    return groupsOf(texels, shared::kWalkTexels);
}

class MomentMaps final : public MapCommands {
public:
    MomentMaps(Recording& recording, const RecorderTraits& traits, const ResolvedOptions& options, std::uint32_t index)
        : recording_(recording), traits_(traits), options_(options), index_(index),
          layers_per_map_(imageLayersPerMap(options.filter(), options.moments())), steps_(options)
    {
    }

    Prepared prepare(const Plan& plan) override;
    void draw(const MapJob& job) override;
    [[nodiscard]] bool covers(const Plan& plan, const View& view) const override;

private:
    [[nodiscard]] ImageRef image(ImageName name) const { return {name, index_}; }
    [[nodiscard]] BufferRef buffer(BufferName name) const { return {name, index_}; }
    [[nodiscard]] bool blurs() const { return blurRadius(options_.moments()) > 0; }
    [[nodiscard]] bool samples() const { return options_.moments().samples > 1; }
    void makeSmall();
    void growMaps(const Plan& plan, Prepared& prepared);
    void growWorking(const Plan& plan);
    void growLayers(const Plan& plan);
    void drawDepth(const MapJob& job, std::uint32_t view);
    void findLayers(const MapJob& job, const View& view, std::uint32_t slot);
    void placeLayers(const MapJob& job, const View& view, std::uint32_t slot);
    void filter(const FilterStep& step);
    void run(std::string_view module, const shared::FilterPassPlace& place, const CommandBinding& source,
             const CommandBinding& target, std::array<std::uint32_t, 3> groups);

    Recording& recording_;
    const RecorderTraits& traits_;
    ResolvedOptions options_;
    std::uint32_t index_;
    std::uint32_t layers_per_map_;
    ScratchStrips strips_;
    bool has_small_ = false;        // the buffers that never change are there
    std::uint32_t layer_slots_ = 0; // of the buffer of layers
    LayerSteps steps_;
};

/// The buffers whose size and contents are those of the options.
void MomentMaps::makeSmall()
{
    if (has_small_) {
        return;
    }
    has_small_ = true;
    const shared::BlurKernel kernel = blurs() ? blurKernel(options_.moments()) : shared::BlurKernel{};
    recording_.upload(buffer(BufferName::kernel), std::span(&kernel, 1));
    const shared::BlurCounts none{};
    recording_.upload(buffer(BufferName::blur_counts), std::span(&none, 1));
}

void MomentMaps::growMaps(const Plan& plan, Prepared& prepared)
{
    const MapPages& pages = plan.pages[index_];
    const ImageRef maps = image(ImageName::maps);
    const ImageShape have = recording_.shapeOf(maps);
    ImageShape shape;
    shape.format = options_.format();
    shape.size_px = {std::max({pages.width, have.size_px.x, 1U}), std::max({pages.height, have.size_px.y, 1U})};
    shape.layers = std::max(pages.layers, 1U) * layers_per_map_;
    shape.levels = recording_.covers(maps, shape.size_px, shape.layers)
                       ? have.levels
                       : mipLevels(options_, shape.size_px.x, shape.size_px.y);
    prepared.changed = recording_.grow(maps, shape);
    prepared.lost =
        prepared.changed && have.size_px.x > 0 && have.levels < shape.levels; // the coarsest are not to be had
    if (pages.kept_layers > 0) {
        (void)recording_.grow(image(ImageName::kept_depths),
                              {MapFormat::d32f, recording_.shapeOf(maps).size_px, pages.kept_layers, 1,
                               static_cast<std::uint32_t>(options_.moments().samples)});
    }
}

/// Grows the images that maps are made in, one after the other, to the size of the largest.
void MomentMaps::growWorking(const Plan& plan)
{
    glm::uvec2 tile(1);
    for (const View& view : plan.views) {
        if (optionsIndexOf(plan, view) == index_) {
            tile = {std::max(tile.x, view.place.tile.width), std::max(tile.y, view.place.tile.height)};
        }
    }
    const ImageRef depths = image(ImageName::depths);
    if (recording_.covers(depths, tile, 0)) {
        return;
    }
    const glm::uvec2 have = recording_.shapeOf(depths).size_px;
    tile = {std::max(tile.x, have.x), std::max(tile.y, have.y)};
    recording_.make(depths, {MapFormat::d32f, tile, 0, 1, static_cast<std::uint32_t>(options_.moments().samples)});
    if (blurs()) {
        strips_ = stripsOf(tile.x, layers_per_map_, traits_.most_layers);
        recording_.make(image(ImageName::strips),
                        {options_.format(), {strips_.width, tile.y}, strips_.count * layers_per_map_});
    }
    const std::uint64_t blocks =
        std::uint64_t{groupsOf(tile.x, shared::kBlockTexels)} * groupsOf(tile.y, shared::kBlockTexels);
    recording_.makeBuffer(buffer(BufferName::blocks_left), 4 * blocks);
}

void MomentMaps::growLayers(const Plan& plan)
{
    const std::uint32_t need = options_.filter() == Filter::lvsm ? depthLayersCount(plan) : 1;
    if (need <= layer_slots_) {
        return;
    }
    const std::uint64_t bytes = std::uint64_t{need} * sizeof(shared::GpuDepthLayers);
    const std::uint32_t copied = steps_.resize(need) ? layer_slots_ : 0;
    recording_.makeBuffer(buffer(BufferName::layers), bytes, copied * sizeof(shared::GpuDepthLayers));
    const shared::GpuDepthLayers first = firstDepthLayers(options_.moments());
    for (std::uint32_t slot = copied; slot < need; ++slot) {
        recording_.write(buffer(BufferName::layers), slot * sizeof(first), first);
    }
    layer_slots_ = need;
    if (steps_.finds()) {
        recording_.makeBuffer(buffer(BufferName::layer_sums), 4 * std::uint64_t{sumsOf(options_.moments())});
    }
}

MapCommands::Prepared MomentMaps::prepare(const Plan& plan)
{
    Prepared prepared;
    makeSmall();
    growMaps(plan, prepared);
    growWorking(plan);
    growLayers(plan);
    return prepared;
}

bool MomentMaps::covers(const Plan& plan, const View& view) const
{
    const Tile& tile = view.place.tile;
    const std::uint32_t kept = view.contents.kept_layer;
    const auto index = static_cast<std::uint32_t>(&view - plan.views.data());
    const ImageRef maps = image(ImageName::maps);
    return recording_.covers(maps, {tile.x + tile.width, tile.y + tile.height}, (tile.layer + 1) * layers_per_map_) &&
           recording_.covers(image(ImageName::depths), {tile.width, tile.height}, 0) &&
           (kept == kNoIndex ||
            recording_.covers(image(ImageName::kept_depths), recording_.shapeOf(maps).size_px, kept + 1)) &&
           (options_.filter() != Filter::lvsm || depthLayersSlot(plan, index) < layer_slots_);
}

void MomentMaps::drawDepth(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const Tile& tile = view.place.tile;
    const Tile working{0, 0, 0, tile.width, tile.height};
    CommandTarget target;
    target.depth = image(ImageName::depths);
    target.viewport = working;
    target.scissor = working;
    if (view.contents.kept_layer == kNoIndex) {
        recording_.add(ClearTarget{target});
        recording_.add(DrawMapCasters{target, index, CasterShare::all});
        return;
    }
    Tile kept = tile;
    kept.layer = view.contents.kept_layer;
    if (job.of(index).draw_kept) {
        CommandTarget still;
        still.depth = image(ImageName::kept_depths);
        still.depth_layer = kept.layer;
        still.viewport = tile;
        still.scissor = tile;
        recording_.add(ClearTarget{still});
        recording_.add(DrawMapCasters{still, index, CasterShare::still});
    }
    recording_.add(CopyTexels{image(ImageName::kept_depths), kept, image(ImageName::depths), working});
    recording_.add(DrawMapCasters{target, index, CasterShare::moving});
}

/// Two passes over the drawn depths.
void MomentMaps::findLayers(const MapJob& job, const View& view, std::uint32_t slot)
{
    constexpr std::uint32_t kGroupSide = 32; // texels of a group along x and y, of either first pass
    const bool gaps = options_.moments().placement == LayerPlacement::gaps;
    const BufferRef sums = buffer(BufferName::layer_sums);
    recording_.add(ZeroBuffer{sums});
    const CommandRange bindings = recording_.bindings(
        {texture(0, image(ImageName::depths)), storage(1, sums), storage(2, buffer(BufferName::layers))});
    const shared::GpuHistogramPush histogram = steps_.histogram(view);
    const auto groups = [&](int texels) {
        const auto sampled = groupsOf(static_cast<std::uint32_t>(texels), static_cast<std::uint32_t>(histogram.more.x));
        return groupsOf(sampled, kGroupSide);
    };
    RunCompute count;
    count.module = gaps ? (samples() ? "depth_layers_gaps_samples.comp" : "depth_layers_gaps.comp")
                        : (samples() ? "depth_layers_histogram_samples.comp" : "depth_layers_histogram.comp");
    count.push = recording_.words(histogram);
    count.bindings = bindings;
    count.groups = {groups(histogram.tile.z), groups(histogram.tile.w), 1};
    recording_.add(count);
    RunCompute place;
    place.module = gaps ? "depth_layers_part.comp" : "depth_layers_place.comp";
    place.push = recording_.words(steps_.place(optionsOf(job.plan, view), view, slot));
    place.bindings = bindings;
    place.groups = {1, 1, 1};
    recording_.add(place);
}

void MomentMaps::placeLayers(const MapJob& job, const View& view, std::uint32_t slot)
{
    if (steps_.areOfWorld()) {
        const shared::GpuDepthLayers layers = worldDepthLayers(view, options_.moments());
        recording_.write(buffer(BufferName::layers), slot * sizeof(layers), layers);
    } else if (steps_.finds()) {
        findLayers(job, view, slot);
    } else {
        return;
    }
    steps_.note(view, slot);
}

void MomentMaps::run(std::string_view module, const shared::FilterPassPlace& place, const CommandBinding& source,
                     const CommandBinding& target, std::array<std::uint32_t, 3> groups)
{
    RunCompute run;
    run.module = module;
    run.constants = recording_.words(filterConstants(options_));
    run.push = recording_.words(place);
    run.bindings = recording_.bindings({source, target, storage(2, buffer(BufferName::blocks_left)),
                                        storage(3, buffer(BufferName::layers)), uniform(4, buffer(BufferName::kernel)),
                                        storage(5, buffer(BufferName::blur_counts))});
    run.groups = groups;
    recording_.add(run);
}

void MomentMaps::filter(const FilterStep& step)
{
    const ImageRef maps = image(ImageName::maps);
    const CommandBinding depths = texture(0, image(ImageName::depths));
    const shared::FilterPassPlace from_depths = placeFromDepths(step);
    const auto blocks_x = static_cast<std::uint32_t>(from_depths.size.z);
    const auto blocks_y = static_cast<std::uint32_t>(from_depths.size.w);
    if (!blurs()) {
        run(samples() ? "moments_samples.comp" : "moments.comp", from_depths, depths, storageImage(1, maps, 0),
            {groupsOf(step.tile.width, 32), walksOf(step.tile.height), step.image_layers});
    } else {
        const ImageRef strips = image(ImageName::strips);
        const CommandBinding from_strips = texture(0, strips, true);
        const shared::FilterPassPlace place = placeOf(step);
        recording_.add(ZeroBuffer{buffer(BufferName::blocks_left)});
        run(samples() ? "blur_moments_samples.comp" : "blur_moments.comp", from_depths, depths,
            storageImage(1, strips, 0), {blocks_x, blocks_y, step.image_layers});
        run("blur_blocks.comp", place, from_strips, storageImage(1, maps, 0),
            {groupsOf(blocks_x, 8), groupsOf(blocks_y, 8), 1});
        run("blur.comp", place, from_strips, storageImage(1, maps, 0), {blocks_x, blocks_y, step.image_layers});
    }
    for (std::uint32_t level = 1; level <= coarsestLevel(step.tile, recording_.shapeOf(maps).levels); ++level) {
        run("mip.comp", placeOfLevel(step, level), texture(0, maps, false, level - 1), storageImage(1, maps, level),
            {groupsOf(step.tile.width >> level, 32), walksOf(step.tile.height >> level), step.image_layers});
    }
}

void MomentMaps::draw(const MapJob& job)
{
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (!job.of(i).draw) {
            continue;
        }
        const View& view = job.plan.views[i];
        drawDepth(job, i);
        FilterStep step;
        step.tile = view.place.tile;
        step.first_layer = view.place.tile.layer * layers_per_map_;
        step.image_layers = layers_per_map_;
        step.strips = strips_;
        step.depth_slot = options_.filter() == Filter::lvsm ? depthLayersSlot(job.plan, i) : 0;
        step.near_over_far = nearOverFar(view, view.projection.metric);
        placeLayers(job, view, step.depth_slot);
        filter(step);
    }
}

} // namespace

std::unique_ptr<MapCommands> makeMomentMaps(Recording& recording, const RecorderTraits& traits,
                                            const ResolvedOptions& options, std::uint32_t index)
{
    return std::make_unique<MomentMaps>(recording, traits, options, index);
}

} // namespace gnomon::pack
