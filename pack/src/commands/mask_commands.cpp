// SPDX-License-Identifier: Apache-2.0
#include "commands/mask_commands.h"

#include <gnomon/pack/page_table.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/discs.h>
#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace gnomon::pack {
namespace {

MapFormat maskFormat(const Plan& plan)
{
    return maskChannelCount(plan) == 1 ? MapFormat::r8 : MapFormat::rgba8;
}

/// "mask_pcf.frag", "mask_pcf_one.frag".
std::string moduleName(Filter filter, bool one_view)
{
    std::string name = "mask_";
    name += nameOf(filter);
    name += one_view ? "_one.frag" : ".frag";
    return name;
}

} // namespace

MaskCommands::MaskCommands(Recording& recording, const RecorderTraits& traits)
    : recording_(recording), traits_(traits), stride_((sizeof(shared::GpuConstants) + traits.uniform_alignment - 1) /
                                                      traits.uniform_alignment * traits.uniform_alignment)
{
}

bool MaskCommands::holds(const Plan& plan) const
{
    return mask().size_px.x > 0 && mask().format == maskFormat(plan) && mask().layers >= plan.mask_layers;
}

/// The resources that never change: stand-ins, and the points of a disc.
void MaskCommands::makeSmall()
{
    if (has_small_) {
        return;
    }
    has_small_ = true;
    recording_.make({ImageName::no_ids}, {{}, glm::uvec2(1), 0});
    recording_.make({ImageName::no_blocks}, {{}, glm::uvec2(1), 1});
    std::array<glm::vec4, shared::kDiscPoints / 2> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {shared::kPoissonPoints[2 * i], shared::kPoissonPoints[2 * i + 1]};
    }
    recording_.upload(BufferRef{BufferName::points}, std::span<const glm::vec4>(points));
}

bool MaskCommands::prepare(const Plan& plan, glm::uvec2 size_px)
{
    makeSmall();
    const bool fits = holds(plan) && mask().size_px == size_px;
    if (!fits) {
        recording_.make({ImageName::mask}, {maskFormat(plan), size_px, std::max(plan.mask_layers, 1U)});
    }
    glm::uvec2 blurred(0);
    for (const ResolvedOptions& options : *plan.options) {
        if (options.technique().soften == Soften::blur) {
            const std::uint32_t scale = pixelsPerTexel(options.screen_blur().size);
            blurred = {std::max(blurred.x, (size_px.x + scale - 1) / scale),
                       std::max(blurred.y, (size_px.y + scale - 1) / scale)};
        }
    }
    for (const ImageName name : {ImageName::blurred, ImageName::blurred_twice}) {
        const bool covers = recording_.covers({name}, blurred, 1) && recording_.shapeOf({name}).format == mask().format;
        if (blurred.x > 0 && !covers) {
            recording_.make({name}, {mask().format, blurred, 1});
        }
    }
    return !fits;
}

void MaskCommands::upload(const Plan& plan, const RecorderInputs& inputs)
{
    const std::size_t options = plan.options->size();
    listMaskDraws(plan, mask().size_px, draws_);
    fillPageTable(plan, page_table_);
    map_images_.assign(options, {});
    constant_words_.assign(options * stride_ / 4, 0);
    for (std::uint32_t i = 0; i < options; ++i) {
        const ImageShape& maps = recording_.shapeOf({ImageName::maps, i});
        if (maps.size_px.x > 0) {
            map_images_[i] = {maps.size_px, maps.levels};
        }
        shared::GpuConstants constants{};
        fillConstants(plan, i, mask().size_px, map_images_[i], inputs.precision, constants);
        std::memcpy(constant_words_.data() + i * stride_ / 4, &constants, sizeof(constants));
    }
    lights_.resize(std::max(maskLightCount(plan), 1U));
    fillMaskLights(plan, draws_, lights_);
    views_.resize(std::max<std::size_t>(plan.views.size(), shared::kFewViews));
    fillViews(plan, map_images_, views_);
    recording_.upload({BufferName::constants}, std::span<const std::uint32_t>(constant_words_));
    recording_.upload({BufferName::lights}, std::span<const shared::GpuLight>(lights_));
    recording_.upload({BufferName::views}, std::span<const shared::GpuView>(views_));
    recording_.upload({BufferName::pages}, std::span<const glm::uvec2>(page_table_));
}

/// All that mask.frag and mask_numbers.vert name; a stand-in where there is none, which no shader reads.
CommandRange MaskCommands::bindingsFor(const Plan& plan, const RecorderInputs& inputs, std::uint32_t options)
{
    const ImageRef maps{ImageName::maps, options};
    const ImageRef depth{ImageName::camera_depth};
    const ImageRef blocks{ImageName::blocks, options};
    const bool has_blocks = recording_.shapeOf(blocks).size_px.x > 0;
    const bool filterable = (*plan.options)[options].filterable();
    const BufferRef lights{BufferName::lights};
    return recording_.bindings({
        uniform(0, {BufferName::constants}, options * stride_, sizeof(shared::GpuConstants)),
        texture(1, maps, filterable),
        storage(2, lights),
        storage(3, {BufferName::views}),
        storage(4, filterable ? BufferRef{BufferName::layers, options} : lights),
        texture(5, depth),
        texture(6, inputs.normals ? ImageRef{ImageName::camera_normal} : depth),
        texture(7, {inputs.ids ? ImageName::camera_ids : ImageName::no_ids}),
        uniform(8, {BufferName::views}, 0, shared::kFewViews * sizeof(shared::GpuView)),
        texture(9, has_blocks ? blocks : ImageRef{ImageName::no_blocks}),
        texture(10, inputs.smooth ? ImageRef{ImageName::camera_smooth} : depth),
        texture(11, maps), // of tints, which no plan here has
        storage(12, page_table_.empty() ? lights : BufferRef{BufferName::pages}),
    });
}

void MaskCommands::drawPart(const Plan& plan, const RecorderInputs& inputs, const MaskDraw& draw, CommandRange bindings)
{
    const ResolvedOptions& options = (*plan.options)[draw.options];
    const Filter filter = filterModule(options);
    // A module for one view serves two as well where its filter compares depths (mask.frag).
    const bool pairs = filter == Filter::hard || filter == Filter::pcf;
    const bool alone = draw.told_apart == ToldApart::alone && traits_.one_view && (pairs || !draw.paired);
    MaskConstants constants = maskConstants(options, {inputs.normals, inputs.ids, inputs.smooth});
    constants.in_software = traits_.in_software ? 1 : 0;
    constants.coloured = draw.coloured ? 1 : 0;
    constants.technique.few_views = draw.few_views;
    constants.slices_alone = draw.told_apart == ToldApart::slices ? 1 : 0;
    constants.paired = alone && draw.paired ? 1 : 0;
    constants.orthographic = !alone && draw.orthographic ? 1 : 0;
    DrawTriangle triangle;
    triangle.target.colour = ImageRef{ImageName::mask};
    triangle.target.colour_layer = draw.layer;
    triangle.target.viewport = {0, 0, 0, mask().size_px.x, mask().size_px.y};
    const ScreenBounds& pixels = draw.pixels;
    triangle.target.scissor = {0, pixels.x0, pixels.y0, pixels.x1 - pixels.x0, pixels.y1 - pixels.y0};
    triangle.vertex = alone ? "mask_numbers_one.vert" : "mask_numbers.vert";
    triangle.fragment = recording_.module(moduleName(filter, alone));
    triangle.constants = recording_.words(constants);
    triangle.push = recording_.words(std::array<std::uint32_t, 4>{draw.first_light, draw.channels, 0, 0});
    triangle.bindings = bindings;
    triangle.least = draw.shares; // a draw writes 1 to channels that are not its own
    recording_.add(triangle);
}

void MaskCommands::draw(const Plan& plan, const RecorderInputs& inputs)
{
    upload(plan, inputs);
    bindings_.assign(plan.options->size(), {});
    CommandTarget layer;
    layer.colour = ImageRef{ImageName::mask};
    layer.viewport = {0, 0, 0, mask().size_px.x, mask().size_px.y};
    layer.scissor = layer.viewport;
    for (std::uint32_t i = 0; i < mask().layers; ++i) {
        layer.colour_layer = i;
        recording_.add(ClearTarget{layer}); // undrawn pixels are lit
        for (const MaskDraw& draw : draws_) {
            if (draw.layer != i) {
                continue;
            }
            CommandRange& bindings = bindings_[draw.options];
            if (bindings.count == 0) {
                bindings = bindingsFor(plan, inputs, draw.options);
            }
            drawPart(plan, inputs, draw, bindings);
        }
    }
    listSoftenDraws(plan, soften_draws_);
    for (const SoftenDraw& draw : soften_draws_) {
        soften(inputs, draw);
    }
}

} // namespace gnomon::pack
