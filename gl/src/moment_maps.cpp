// SPDX-License-Identifier: Apache-2.0
#include "moment_maps.h"

#include <gnomon/error.h>
#include <gnomon/pack/depth_layers.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/gpu_structs.h>
#include <gnomon/shared/layer_gaps.h>

#include <algorithm>
#include <string>

namespace gnomon::gl {
namespace {

void requireFiltering(const Context& context, GLenum format, const ResolvedOptions& options)
{
    GLint filters = 0;
    context.gl.GetInternalformativ(GL_TEXTURE_2D_ARRAY, format, GL_FILTER, 1, &filters);
    if (filters == GL_FALSE) {
        throw Error("make shadow maps by OpenGL",
                    "the context cannot filter maps of format " + std::string(nameOf(options.format())),
                    "choose another map format");
    }
}

std::uint32_t sumsOf(const MomentOptions& options)
{
    return options.placement == LayerPlacement::gaps ? shared::kGapBins * shared::kGapColumns : shared::kDepthBins;
}

} // namespace

MomentMaps::MomentMaps(const Context& context, Programs& programs, const ResolvedOptions& options)
    : context_(context), programs_(programs), options_(options), storage_(mapStorage(options.format())),
      layers_per_map_(imageLayersPerMap(options.filter(), options.moments())), target_(context),
      nearest_(makeSampler(context, false)), linear_(makeSampler(context, true)), blocks_(makeBuffer(context)),
      kernel_(makeBuffer(context)), counts_(makeBuffer(context)), layers_(makeBuffer(context)),
      sums_(makeBuffer(context)), steps_(options), constants_(wordsOf(pack::filterConstants(options)))
{
    requireFiltering(context, storage_.colour, options);
    const shared::BlurKernel kernel =
        blurRadius(options.moments()) > 0 ? pack::blurKernel(options.moments()) : shared::BlurKernel{};
    upload(context, kernel_, std::span(&kernel, 1));
    const shared::BlurCounts none{};
    upload(context, counts_, std::span(&none, 1));
}

void MomentMaps::growMaps(const Plan& plan, std::uint32_t options, Prepared& prepared)
{
    const MapPages& pages = plan.pages[options];
    ImageInfo info;
    info.format = storage_.colour;
    info.size = {std::max({pages.width, maps_.info().size.x, 1U}), std::max({pages.height, maps_.info().size.y, 1U})};
    info.layers = std::max(pages.layers, 1U) * layers_per_map_;
    info.levels = maps_.covers(info.size, info.layers) ? maps_.info().levels
                                                       : pack::mipLevels(options_, info.size.x, info.size.y);
    const std::uint32_t had = maps_ ? maps_.info().levels : info.levels;
    prepared.changed = growImage(context_, maps_, info);
    prepared.lost = prepared.changed && had < info.levels; // the coarsest are nowhere to be had
    if (prepared.changed) {
        levels_.clear();
        for (std::uint32_t level = 0; level < info.levels; ++level) {
            levels_.push_back(maps_.viewOfLevel(context_, level));
        }
    }
    if (pages.kept_layers > 0) {
        (void)growImage(context_, kept_,
                        {storage_.depth, maps_.info().size, pages.kept_layers, 1, options_.moments().samples});
    }
}

/// Grows the images that maps are made in, one after the other, to the size of the largest.
void MomentMaps::growWorking(const Plan& plan, std::uint32_t options)
{
    glm::uvec2 tile(1);
    for (const View& view : plan.views) {
        if (optionsIndexOf(plan, view) == options) {
            tile = {std::max(tile.x, view.place.tile.width), std::max(tile.y, view.place.tile.height)};
        }
    }
    if (depth_.covers(tile, 0)) {
        return;
    }
    tile = {std::max(tile.x, depth_.info().size.x), std::max(tile.y, depth_.info().size.y)};
    depth_ = Image(context_, {storage_.depth, tile, 0, 1, options_.moments().samples});
    if (blurRadius(options_.moments()) > 0) {
        strips_ = pack::stripsOf(tile.x, layers_per_map_, context_.most_layers);
        scratch_ = Image(context_, {storage_.colour, {strips_.width, tile.y}, strips_.count * layers_per_map_});
    }
    const std::uint32_t blocks =
        pack::groupsOf(tile.x, shared::kBlockTexels) * pack::groupsOf(tile.y, shared::kBlockTexels);
    context_.gl.NamedBufferData(blocks_.name(), GLsizeiptr{4} * blocks, nullptr, GL_DYNAMIC_COPY);
}

void MomentMaps::growLayers(const Plan& plan)
{
    const std::uint32_t need = options_.filter() == Filter::lvsm ? pack::depthLayersCount(plan) : 1;
    if (need <= layer_slots_) {
        return;
    }
    const std::vector<shared::GpuDepthLayers> first(need, pack::firstDepthLayers(options_.moments()));
    Buffer larger = makeBuffer(context_);
    upload(context_, larger, std::span(first));
    if (steps_.resize(need)) {
        context_.gl.CopyNamedBufferSubData(
            layers_.name(), larger.name(), 0, 0,
            static_cast<GLsizeiptr>(layer_slots_ * sizeof(shared::GpuDepthLayers)));
    }
    layers_ = std::move(larger);
    layer_slots_ = need;
    if (steps_.finds()) {
        context_.gl.NamedBufferData(sums_.name(), GLsizeiptr{4} * sumsOf(options_.moments()), nullptr,
                                    GL_DYNAMIC_COPY);
    }
}

MapRecorder::Prepared MomentMaps::prepare(const Plan& plan, std::uint32_t options)
{
    Prepared prepared;
    growMaps(plan, options, prepared);
    growWorking(plan, options);
    growLayers(plan);
    return prepared;
}

bool MomentMaps::covers(const Plan& plan, const View& view) const
{
    const Tile& tile = view.place.tile;
    const std::uint32_t kept = view.contents.kept_layer;
    const auto index = static_cast<std::uint32_t>(&view - plan.views.data());
    return maps_.covers({tile.x + tile.width, tile.y + tile.height}, (tile.layer + 1) * layers_per_map_) &&
           depth_.covers({tile.width, tile.height}, 0) &&
           (kept == kNoIndex || kept_.covers(maps_.info().size, kept + 1)) &&
           (options_.filter() != Filter::lvsm || pack::depthLayersSlot(plan, index) < layer_slots_);
}

void MomentMaps::drawDepth(const MapJob& job, std::uint32_t index)
{
    const View& view = job.plan.views[index];
    const Tile& tile = view.place.tile;
    const Tile working{0, 0, 0, tile.width, tile.height};
    const bool keeps = view.contents.kept_layer != kNoIndex;
    if (keeps) {
        Tile kept = tile;
        kept.layer = view.contents.kept_layer;
        if (job.of(index).draw_kept) {
            target_.bind(nullptr, 0, &kept_, kept.layer);
            setViewport(context_, tile);
            setScissor(context_, tile);
            target_.clearDepth();
            drawCasters(context_, job, index, pack::CasterShare::still);
        }
        copyTexels(context_, kept_, kept, depth_, working);
    }
    target_.bind(nullptr, 0, &depth_, 0);
    setViewport(context_, working);
    setScissor(context_, working);
    if (!keeps) {
        target_.clearDepth();
    }
    drawCasters(context_, job, index, keeps ? pack::CasterShare::moving : pack::CasterShare::all);
}

void MomentMaps::placeLayers(const MapJob& job, std::uint32_t index, std::uint32_t slot)
{
    const View& view = job.plan.views[index];
    if (steps_.areOfWorld()) {
        const shared::GpuDepthLayers layers = pack::worldDepthLayers(view, options_.moments());
        context_.gl.NamedBufferSubData(layers_.name(), static_cast<GLintptr>(slot * sizeof layers), sizeof layers,
                                       &layers);
    } else if (steps_.finds()) {
        constexpr std::uint32_t kGroupSide = 32; // texels of a group along x and y, of either first pass
        const bool gaps = options_.moments().placement == LayerPlacement::gaps;
        const bool samples = options_.moments().samples > 1;
        const char* const count =
            gaps ? (samples ? "depth_layers_gaps_samples.comp" : "depth_layers_gaps.comp")
                 : (samples ? "depth_layers_histogram_samples.comp" : "depth_layers_histogram.comp");
        context_.gl.ClearNamedBufferData(sums_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        context_.gl.BindTextureUnit(0, depth_.name());
        context_.gl.BindSampler(0, nearest_.name());
        context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, sums_.name());
        context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, layers_.name());
        const shared::GpuHistogramPush histogram = steps_.histogram(view);
        const auto groups = [&](int texels) {
            const auto sampled = pack::groupsOf(static_cast<std::uint32_t>(texels),
                                                static_cast<std::uint32_t>(histogram.more.x));
            return pack::groupsOf(sampled, kGroupSide);
        };
        context_.gl.UseProgram(programs_.compute(count));
        programs_.push(histogram);
        context_.gl.DispatchCompute(groups(histogram.tile.z), groups(histogram.tile.w), 1);
        waitForShaders(context_);
        context_.gl.UseProgram(programs_.compute(gaps ? "depth_layers_part.comp" : "depth_layers_place.comp"));
        programs_.push(steps_.place(optionsOf(job.plan, view), view, slot));
        context_.gl.DispatchCompute(1, 1, 1);
        waitForShaders(context_);
    } else {
        return;
    }
    steps_.note(view, slot);
}

void MomentMaps::bind(GLuint source, const Sampler& sampler, const Image& target, std::uint32_t level)
{
    context_.gl.BindTextureUnit(0, source);
    context_.gl.BindSampler(0, sampler.name());
    context_.gl.BindImageTexture(1, target.name(), static_cast<GLint>(level), GL_TRUE, 0, GL_WRITE_ONLY,
                                 storage_.colour);
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, blocks_.name());
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, layers_.name());
    context_.gl.BindBufferBase(GL_UNIFORM_BUFFER, 4, kernel_.name());
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, counts_.name());
}

void MomentMaps::run(const char* module, const shared::FilterPassPlace& place, std::uint32_t x, std::uint32_t y,
                     std::uint32_t z)
{
    context_.gl.UseProgram(programs_.compute(module, constants_));
    programs_.push(place);
    context_.gl.DispatchCompute(x, y, z);
    waitForShaders(context_);
}

void MomentMaps::filter(const pack::FilterStep& step)
{
    const bool samples = options_.moments().samples > 1;
    const shared::FilterPassPlace from_depths = pack::placeFromDepths(step);
    const auto blocks_x = static_cast<std::uint32_t>(from_depths.size.z);
    const auto blocks_y = static_cast<std::uint32_t>(from_depths.size.w);
    const auto walks = [](std::uint32_t texels) {
        return pack::groupsOf(texels, shared::kWalkTexels);
    };
    if (!scratch_) {
        bind(depth_.name(), nearest_, maps_, 0);
        run(samples ? "moments_samples.comp" : "moments.comp", from_depths, pack::groupsOf(step.tile.width, 32),
            walks(step.tile.height), step.image_layers);
    } else {
        const shared::FilterPassPlace place = pack::placeOf(step);
        context_.gl.ClearNamedBufferData(blocks_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        bind(depth_.name(), nearest_, scratch_, 0);
        run(samples ? "blur_moments_samples.comp" : "blur_moments.comp", from_depths, blocks_x, blocks_y,
            step.image_layers);
        bind(scratch_.name(), linear_, maps_, 0);
        run("blur_blocks.comp", place, pack::groupsOf(blocks_x, 8), pack::groupsOf(blocks_y, 8), 1);
        run("blur.comp", place, blocks_x, blocks_y, step.image_layers);
    }
    for (std::uint32_t level = 1; level <= pack::coarsestLevel(step.tile, maps_.info().levels); ++level) {
        bind(levels_[level - 1].name(), nearest_, maps_, level);
        run("mip.comp", pack::placeOfLevel(step, level), pack::groupsOf(step.tile.width >> level, 32),
            walks(step.tile.height >> level), step.image_layers);
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
        pack::FilterStep step;
        step.tile = view.place.tile;
        step.first_layer = view.place.tile.layer * layers_per_map_;
        step.image_layers = layers_per_map_;
        step.strips = strips_;
        step.depth_slot = options_.filter() == Filter::lvsm ? pack::depthLayersSlot(job.plan, i) : 0;
        step.near_over_far = pack::nearOverFar(view, view.projection.metric);
        placeLayers(job, i, step.depth_slot);
        filter(step);
    }
}

} // namespace gnomon::gl
