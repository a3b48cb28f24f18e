// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/mask_draws.h>

#include "light_strip.h"
#include "reach_cells.h"

#include <gnomon/error.h>
#include <gnomon/pack/page_table.h>
#include <gnomon/pack/shading_buffers.h>
#include <gnomon/pack/technique_constants.h>
#include <gnomon/plan_views.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::pack {
namespace {

// A strip of the screen, and of each of a layer's lights what it shows.
struct Strip {
    std::uint32_t begin = 0; // pixels, x
    std::uint32_t end = 0;
    std::array<SunShown, shared::kLightsPerLayer> shown{}; // by mask channel
};
struct Strips {
    static constexpr std::uint32_t kMost = 2 * shared::kLightsPerLayer + 1;
    std::array<Strip, kMost> strips;
    std::uint32_t count = 0;

    [[nodiscard]] const Strip* begin() const { return strips.data(); }
    [[nodiscard]] const Strip* end() const { return strips.data() + count; }
};

bool hasBand(const LightPlan& light)
{
    const SunSteps& steps = light.steps;
    return light.outcome.hasMap() && steps.paired && !steps.alternate && steps.band > 0.0;
}

// Pixels of the screen's width; a share of it that is not a number counts as 0.
std::uint32_t pixels(double share, std::uint32_t width, double (*round)(double))
{
    return share > 0.0 ? static_cast<std::uint32_t>(round(std::min(share, 1.0) * width)) : 0;
}

// The pixels of a band: to the left of `begin` only the later position counts, from `end` on only the earlier one.
// Rounded outwards, so that a pixel on an edge is in the band.
struct BandPixels {
    std::uint32_t begin;
    std::uint32_t end;
};
BandPixels bandPixels(const SunSteps& steps, std::uint32_t width)
{
    return {pixels(steps.edge - steps.band, width, std::floor), pixels(steps.edge, width, std::ceil)};
}

// In a strip that begins at pixel x and has no edge of a band inside.
SunShown shownAt(const LightPlan& light, std::uint32_t x, std::uint32_t width)
{
    const SunSteps& steps = light.steps;
    if (!light.outcome.hasMap() || !steps.paired) {
        return SunShown::all;
    }
    if (steps.alternate) {
        return steps.read == SunPosition::later ? SunShown::later : SunShown::earlier;
    }
    if (hasBand(light)) {
        const BandPixels band = bandPixels(steps, width);
        return x < band.begin ? SunShown::later : x >= band.end ? SunShown::earlier : SunShown::all;
    }
    const double weight = laterWeight(steps, 0.0);
    return weight <= 0.0 ? SunShown::earlier : weight >= 1.0 ? SunShown::later : SunShown::all;
}

// They cover the screen, from left to right.
Strips stripsOf(const Plan& plan, std::uint32_t layer, std::uint32_t width)
{
    std::array<std::uint32_t, Strips::kMost + 1> edges{};
    std::uint32_t edge_count = 0;
    edges[edge_count++] = 0;
    edges[edge_count++] = width;
    for (const LightPlan& light : plan.lights) {
        if (light.mask_layer == layer && hasBand(light) && edge_count + 2 <= edges.size()) {
            const BandPixels band = bandPixels(light.steps, width);
            edges[edge_count++] = std::min(band.begin, width);
            edges[edge_count++] = std::min(band.end, width);
        }
    }
    std::ranges::sort(std::span(edges).first(edge_count));
    Strips result;
    for (std::uint32_t i = 0; i + 1 < edge_count; ++i) {
        if (edges[i] == edges[i + 1]) {
            continue;
        }
        Strip& strip = result.strips[result.count++];
        strip.begin = edges[i];
        strip.end = edges[i + 1];
        for (const LightPlan& light : plan.lights) {
            if (light.mask_layer == layer) {
                strip.shown[light.mask_channel] = shownAt(light, strip.begin, width);
            }
        }
    }
    return result;
}

bool isOrthographic(const Plan& plan, const ShownViews& shown)
{
    const auto all = [&](std::uint32_t first, std::uint32_t count) {
        return std::all_of(plan.views.begin() + first, plan.views.begin() + first + count,
                           [](const View& view) { return view.projection.orthographic; });
    };
    return all(shown.first, shown.count) && all(shown.later_first, shown.later_count);
}

// Does a view serve all that is on its map? What the GPU has yet to fit will have a slice.
bool servesAll(const View& view)
{
    return !view.serves.slice.bounded() && !view.serves.sector.bounded() && view.projection.gpu_cascade == kNoIndex;
}

ToldApart toldApart(std::span<const View> views)
{
    const View& first = views.front();
    if (views.size() == 1) {
        return servesAll(first) ? ToldApart::alone : ToldApart::tests;
    }
    const bool slices = std::ranges::all_of(views, [&](const View& view) {
        return !view.serves.sector.bounded() && !view.serves.slice.isRatio() &&
               view.serves.slice.axis == first.serves.slice.axis;
    });
    return slices ? ToldApart::slices : ToldApart::tests;
}

// For a sun in steps that is a plan's only light with views: where each seen position has one view, these views are
// known beforehand.
void knowPositions(const Plan& plan, MaskDraw& draw)
{
    const LightPlan& light = plan.lights.front();
    const ShownViews views = shownViews(plan, light, draw.shown[light.mask_channel]);
    const bool one_each = views.count == 1 && (views.later_count == 0 || (views.later_count == 1 && draw.orthographic));
    const std::uint32_t last = views.later_count > 0 ? views.later_first : views.first;
    if (one_each && last < shared::kFewViews && servesAll(plan.views[views.first]) && servesAll(plan.views[last])) {
        draw.told_apart = ToldApart::alone;
        draw.paired = views.later_count > 0;
    }
}

// Is the mask's first light the only one with views?
bool isAlone(const Plan& plan)
{
    const LightPlan& light = plan.lights.front();
    const bool is_first = plan.lights.size() == 1 || (light.mask_layer == 0 && light.mask_channel == 0);
    return is_first && light.view_count == plan.views.size();
}

// The lights of one strip of a layer that have these options.
MaskDraw drawOf(const Plan& plan, std::uint32_t layer, const Strip& strip, std::uint32_t options)
{
    MaskDraw draw;
    draw.layer = layer;
    draw.options = options;
    draw.shown = strip.shown;
    for (const LightPlan& light : plan.lights) {
        if (light.mask_layer != layer || light.options != options) {
            continue;
        }
        const ShownViews views = shownViews(plan, light, strip.shown[light.mask_channel]);
        if (views.count > 0) {
            draw.channels |= maskChannelsOf(light);
            draw.coloured = light.mask_coloured;
            draw.orthographic = draw.orthographic && isOrthographic(plan, views);
        }
    }
    if (draw.channels == 0 || !isAlone(plan) || hasPages((*plan.options)[options])) { // which are found by a table
        return draw;
    }
    draw.few_views = fewViewsOf(plan, plan.lights.front());
    if (draw.few_views > 0) {
        draw.told_apart = toldApart(plan.views);
    } else {
        knowPositions(plan, draw);
    }
    return draw;
}

// Whether the motion, which does not change from frame to frame, may part the screen.
bool mayHaveBands(const Plan& plan)
{
    const auto steps_in_bands = [](const ResolvedOptions& options) {
        return options.technique().motion == Motion::step_band;
    };
    return std::ranges::any_of(*plan.options, steps_in_bands) ||
           std::ranges::any_of(plan.lights, [](const LightPlan& light) { return light.steps.band > 0.0; });
}

// Where the lights of one layer reach, by mask channel. An unknown light reaches everywhere.
LayerReach reachOf(const Plan& plan, std::uint32_t layer, glm::uvec2 size_px)
{
    LayerReach reach;
    const PlannedFrame& from = plan.made_for;
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& light = plan.lights[i];
        if (light.mask_layer == layer && light.outcome.hasMap()) {
            const bool known = i < from.lights.size();
            reach.add(maskChannelsOf(light), known ? litPixels(from.lights[i], from.camera, from.scene_ws, size_px)
                                                   : ScreenBounds{0, 0, size_px.x, size_px.y});
        }
    }
    return reach;
}

// The draws of one strip by options, and of each its parts by where lights reach.
void listStrip(const Plan& plan, std::uint32_t layer, const Strip& strip, const ReachCells& cells,
               std::uint32_t first_light, std::vector<MaskDraw>& out)
{
    const std::size_t first_draw = out.size();
    std::uint32_t drawn = 0; // options that have something to draw
    for (std::uint32_t options = 0; options < plan.options->size(); ++options) {
        MaskDraw draw = drawOf(plan, layer, strip, options);
        draw.first_light = first_light;
        assert(draw.few_views == 0 || first_light == 0); // few views are of the first of all lights
        const std::uint32_t channels = draw.channels;
        drawn += channels != 0 ? 1 : 0;
        for (const ReachCell& cell : cells) {
            draw.channels = channels & cell.channels;
            draw.pixels = cell.pixels;
            if (draw.channels != 0) {
                out.push_back(draw);
            }
        }
    }
    for (std::size_t i = first_draw; i < out.size(); ++i) {
        out[i].shares = drawn > 1;
    }
}

} // namespace

glm::vec4 stepRule(const SunSteps& steps)
{
    return {steps.share, steps.edge, steps.band > 0.0 ? 1.0 / steps.band : 0.0, steps.smooth ? 1.0 : 0.0};
}

ShownViews shownViews(const Plan& plan, const LightPlan& light, SunShown shown)
{
    if (!light.outcome.hasMap()) {
        return {};
    }
    if (!light.steps.paired) {
        return {light.first_view, light.view_count, 0, 0};
    }
    std::uint32_t earlier = 0;
    while (earlier < light.view_count && plan.views[light.first_view + earlier].serves.sun != SunPosition::later) {
        ++earlier;
    }
    const std::uint32_t later = light.view_count - earlier;
    const std::uint32_t later_first = light.first_view + earlier;
    // A position without views says nothing: the other one stands for both.
    if (later == 0 || (shown == SunShown::earlier && earlier > 0)) {
        return {light.first_view, earlier, 0, 0};
    }
    if (earlier == 0 || shown == SunShown::later) {
        return {later_first, later, 0, 0};
    }
    return {light.first_view, earlier, later_first, later};
}

void listMaskDraws(const Plan& plan, glm::uvec2 size_px, std::vector<MaskDraw>& out)
{
    out.clear();
    const std::uint32_t layers = std::max(plan.mask_layers, 1U);
    std::uint32_t next = layers * shared::kLightsPerLayer;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const Strips strips = stripsOf(plan, layer, size_px.x);
        const LayerReach reach = reachOf(plan, layer, size_px);
        for (const Strip& strip : strips) {
            std::uint32_t first_light = layer * shared::kLightsPerLayer;
            if (strips.count > 1) { // lights of this strip alone
                first_light = next;
                next += shared::kLightsPerLayer;
            }
            const ReachCells cells(reach, {strip.begin, 0, strip.end, size_px.y});
            listStrip(plan, layer, strip, cells, first_light, out);
        }
    }
}

ScreenBounds halfTexels(const ScreenBounds& pixels, glm::uvec2 size_px)
{
    // The pixel of texel t is 2 t + 1, or the last one.
    const auto end = [](std::uint32_t pixel, std::uint32_t size) {
        return pixel >= size ? (size + 1) / 2 : pixel / 2;
    };
    return {pixels.x0 / 2, pixels.y0 / 2, end(pixels.x1, size_px.x), end(pixels.y1, size_px.y)};
}

std::size_t mostMaskDraws(const Plan& plan)
{
    const std::size_t strips = mayHaveBands(plan) ? Strips::kMost : 1;
    const std::size_t kinds = std::min<std::size_t>(plan.options->size(), shared::kLightsPerLayer);
    return std::max(plan.mask_layers, 1U) * strips * ReachCells::kMost * kinds;
}

std::uint32_t maskLightCount(const Plan& plan)
{
    return std::max(plan.mask_layers, 1U) * shared::kLightsPerLayer * (mayHaveBands(plan) ? 1 + Strips::kMost : 1U);
}

void fillMaskLights(const Plan& plan, std::span<const MaskDraw> draws, std::span<shared::GpuLight> lights)
{
    if (plan.made_for.lights.size() != plan.lights.size()) {
        throw Error("describe lights to the mask pass", "the plan does not say what they are (Plan::made_for)");
    }
    std::ranges::fill(lights, shared::GpuLight{});
    std::uint32_t place = 0;
    std::uint32_t filled = 0; // channels of the lights at `place`, which draws of one strip share
    for (const MaskDraw& draw : draws) {
        if (draw.first_light + std::size_t{shared::kLightsPerLayer} > lights.size()) {
            throw Error("describe lights to the mask pass", "there is no room for those of all strips",
                        "give room for maskLightCount() lights");
        }
        filled = draw.first_light == place ? filled : 0;
        place = draw.first_light;
        const std::uint32_t wanted = draw.channels & ~filled;
        filled |= draw.channels;
        for (std::size_t i = 0; wanted != 0 && i < plan.lights.size(); ++i) {
            const LightPlan& light = plan.lights[i];
            const std::uint32_t channels = maskChannelsOf(light) & wanted;
            for (std::uint32_t channel = 0; light.mask_layer == draw.layer && channels >> channel != 0; ++channel) {
                if ((channels >> channel & 1U) != 0) {
                    fillLight(plan, i, draw.shown[light.mask_channel], lights[draw.first_light + channel]);
                }
            }
        }
    }
}

} // namespace gnomon::pack
