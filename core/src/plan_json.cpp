// SPDX-License-Identifier: Apache-2.0
#include <gnomon/object_ids.h>
#include <gnomon/plan.h>

#include "json_writer.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace gnomon {
namespace {

void writeTechnique(JsonWriter& json, const Technique& technique)
{
    json.openLine("technique", '{');
    json.value("partition", nameOf(technique.partition));
    json.value("fit", nameOf(technique.fit));
    json.value("filter", nameOf(technique.filter));
    json.value("soften", nameOf(technique.soften));
    json.value("motion", nameOf(technique.motion));
    json.closeLine('}');
}

// A plan that no planner made may have none.
const std::vector<ResolvedOptions>& noOptions()
{
    static const std::vector<ResolvedOptions> defaults(1, resolvedOrThrow({}));
    return defaults;
}

void writeFade(JsonWriter& json, const ResolvedOptions& options)
{
    json.openLine("fade", '{');
    json.value("begin_m", options.fadeBegin_m());
    json.value("end_m", options.fadeEnd_m());
    json.closeLine('}');
}

// "technique" and "fade" are the first options'. A planner with one of them has no list.
void writeFurtherOptions(JsonWriter& json, std::span<const ResolvedOptions> further)
{
    if (further.empty()) {
        return;
    }
    json.open("further_options", '[');
    for (const ResolvedOptions& options : further) {
        json.open({}, '{');
        writeTechnique(json, options.technique());
        writeFade(json, options);
        json.close('}');
    }
    json.close(']');
}

std::string_view nameOf(SunPosition sun)
{
    switch (sun) {
    case SunPosition::only:
        return "only";
    case SunPosition::earlier:
        return "earlier";
    case SunPosition::later:
        return "later";
    }
    return "?";
}

std::string_view nameOf(TexelPart part)
{
    switch (part) {
    case TexelPart::whole:
        return "whole";
    case TexelPart::first:
        return "first";
    case TexelPart::second:
        return "second";
    }
    return "?";
}

void writeSample(JsonWriter& json, const LightSample& sample)
{
    if (!sample.joined) {
        json.nothing("sample");
        return;
    }
    json.openLine("sample", '{');
    json.vector("position_ws", sample.position_ws, 3);
    json.vector("direction_ws", sample.direction_ws, 3);
    json.closeLine('}');
}

void writeSteps(JsonWriter& json, const SunSteps& steps)
{
    if (!steps.stepping) {
        json.nothing("steps");
        return;
    }
    json.openLine("steps", '{');
    json.flag("paired", steps.paired);
    json.vector("earlier_ws", steps.earlier_ws, 3);
    json.vector("later_ws", steps.later_ws, 3);
    json.value("share", steps.share);
    json.flag("smooth", steps.smooth);
    json.value("band", steps.band);
    json.value("edge", steps.edge);
    json.flag("alternate", steps.alternate);
    json.value("read", nameOf(steps.read));
    json.closeLine('}');
}

// Lights that leave nothing to the planner have no entry.
void writeChoice(JsonWriter& json, const AutoChoice& choice)
{
    if (!choice.made) {
        return;
    }
    json.openLine("auto", '{');
    json.value("partition", nameOf(choice.partition));
    json.value("texels_per_pixel", choice.texels_per_pixel);
    json.value("error", choice.error);
    json.value("other_error", choice.other_error);
    json.value("halvings", choice.halvings);
    json.value("time_ms", choice.time_ms);
    json.value("rates", nameOf(choice.rates));
    json.value("reason", choice.reason);
    json.closeLine('}');
}

// Lights whose maps hold no ids have no entry.
void writeIds(JsonWriter& json, const Plan& plan, std::uint32_t light)
{
    if (plan.lights[light].first_object_id == kNoIndex) {
        return;
    }
    const IdCollisions counted = countIdCollisions(plan, light);
    json.openLine("ids", '{');
    json.value("casters", counted.casters);
    json.value("ids", counted.ids);
    json.value("taken", counted.taken);
    json.value("pairs", counted.pairs);
    json.value("collisions", counted.collisions);
    json.closeLine('}');
}

void writeLight(JsonWriter& json, const Plan& plan, std::uint32_t index)
{
    const LightPlan& light = plan.lights[index];
    json.openLine({}, '{');
    json.value("outcome", nameOf(light.outcome.kind));
    json.value("reason", light.outcome.reason);
    json.value("first_view", light.first_view);
    json.value("view_count", light.view_count);
    if (light.volume_count > 0 || light.left_out > 0) {
        json.value("first_volume", light.first_volume);
        json.value("volume_count", light.volume_count);
        json.value("left_out", light.left_out);
    }
    json.value("mask_layer", light.mask_layer);
    json.value("mask_channel", light.mask_channel);
    json.flag("mask_coloured", light.mask_coloured);
    json.value("options", light.options);
    json.value("halved", light.halved);
    json.value("waited", light.waited);
    writeSteps(json, light.steps);
    writeChoice(json, light.choice);
    writeSample(json, light.sample);
    writeIds(json, plan, index);
    json.closeLine('}');
}

void writePages(JsonWriter& json, const MapPages& pages)
{
    json.openLine({}, '{');
    json.value("width", pages.width);
    json.value("height", pages.height);
    json.value("layers", pages.layers);
    json.value("kept_layers", pages.kept_layers);
    json.value("wanted_texels", pages.wanted_texels);
    json.value("given_texels", pages.given_texels);
    json.value("drawn_texels", pages.drawn_texels);
    json.value("waiting_lights", pages.waiting_lights);
    json.value("waiting_maps", pages.waiting_maps);
    json.value("longest_wait", pages.longest_wait);
    json.closeLine('}');
}

// Not what it holds: those numbers differ from planner to planner.
void writeMap(JsonWriter& json, const MapId& map)
{
    if (!map) {
        json.nothing("map");
        return;
    }
    json.openLine("map", '{');
    json.value("index", map.index);
    json.value("generation", map.generation);
    json.closeLine('}');
}

/// Where what stands still is kept, and what of the map is restored from there.
void writeKept(JsonWriter& json, const View& view)
{
    if (view.contents.kept_layer == kNoIndex) {
        json.nothing("kept");
        return;
    }
    json.openLine("kept", '{');
    writeMap(json, view.contents.kept_map);
    json.value("layer", view.contents.kept_layer);
    json.flag("redraw", view.contents.redraw_kept);
    json.value("still_count", view.casters.still);
    json.openLine("dirty", '{');
    json.value("x", view.contents.dirty.x);
    json.value("y", view.contents.dirty.y);
    json.value("width", view.contents.dirty.width);
    json.value("height", view.contents.dirty.height);
    json.closeLine('}');
    json.closeLine('}');
}

void writeView(JsonWriter& json, const Plan& plan, const View& view)
{
    json.open({}, '{');
    json.value("light", view.light);
    writeMap(json, view.place.map);
    json.openLine("tile", '{');
    json.value("layer", view.place.tile.layer);
    json.value("x", view.place.tile.x);
    json.value("y", view.place.tile.y);
    json.value("width", view.place.tile.width);
    json.value("height", view.place.tile.height);
    json.closeLine('}');
    json.value("part", nameOf(view.place.part));
    json.value("sun", nameOf(view.serves.sun));
    json.flag("redraw", view.contents.redraw);
    json.value("waited", view.contents.waited);
    writeKept(json, view);
    json.flag("orthographic", view.projection.orthographic);
    json.flag("parallel", view.projection.parallel);
    if (view.projection.paraboloid) {
        json.flag("paraboloid", true);
    }
    json.flag("clamp_near", view.projection.clamp_near);
    json.value("texel_m", view.projection.texel_m);
    json.vector("texel_xy_m", view.projection.texel_xy_m, 2);
    json.openLine("fit", '{');
    json.value("strength", view.fit.strength);
    json.vector("finest_texel", view.fit.finest_texel, 2);
    json.vector("coarsest_texel", view.fit.coarsest_texel, 2);
    json.closeLine('}');
    json.openLine("slice", '{');
    json.value("begin_m", view.serves.slice.begin_m);
    json.value("end_m", view.serves.slice.end_m);
    json.value("blend_m", view.serves.slice.blend_m);
    json.vector("axis", view.serves.slice.axis, 4);
    if (view.serves.slice.isRatio()) {
        json.vector("over", view.serves.slice.over, 4);
    }
    json.closeLine('}');
    if (view.serves.faded_in < 1.0) {
        json.value("faded_in", view.serves.faded_in);
    }
    if (view.serves.layered) {
        json.value("rim", view.serves.rim);
    }
    if (view.serves.sector.bounded()) {
        json.openLine("sector", '{');
        json.vector("x", view.serves.sector.x, 4);
        json.vector("y", view.serves.sector.y, 4);
        json.vector("w", view.serves.sector.w, 4);
        json.closeLine('}');
    }
    if (view.projection.gpu_cascade != kNoIndex) {
        json.value("gpu_cascade", view.projection.gpu_cascade);
    }
    json.vector("light_place_ws", view.projection.light_place_ws, 3);
    json.open("clip_from_world_rows", '[');
    for (int row = 0; row < 4; ++row) {
        json.openLine({}, '[');
        for (int column = 0; column < 4; ++column) {
            json.value({}, view.projection.clip_from_world[column][row]);
        }
        json.closeLine(']');
    }
    json.close(']');
    json.openLine("metric", '{');
    json.value("near_m", view.projection.metric.near_m);
    json.value("far_m", view.projection.metric.far_m);
    json.vector("metric_ws", view.projection.metric.metric_ws, 4);
    json.closeLine('}');
    if (view.serves.layers[0] != DepthSpan{}) {
        json.openLine("world_layers", '[');
        for (const DepthSpan& layer : view.serves.layers) {
            if (layer != DepthSpan{}) {
                json.value({}, layer.near);
                json.value({}, layer.far);
            }
        }
        json.closeLine(']');
    }
    json.openLine("casters", '[');
    for (std::uint32_t i = 0; i < view.casters.count; ++i) {
        json.value({}, plan.casters[view.casters.first + i]);
    }
    json.closeLine(']');
    json.close('}');
}

/// One line per object that is seen or casts: who it is, whether the camera sees it, which views it is drawn in.
void writeObjects(JsonWriter& json, const Plan& plan)
{
    std::vector<std::pair<std::uint32_t, bool>> objects;
    for (const std::uint32_t object : plan.receivers) {
        objects.emplace_back(object, true);
    }
    for (const std::uint32_t object : plan.casters) {
        objects.emplace_back(object, false);
    }
    std::sort(objects.begin(), objects.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second > b.second;
    });
    objects.erase(
        std::unique(objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
        objects.end());
    json.open("objects", '[');
    for (const auto& [object, seen] : objects) {
        json.openLine({}, '{');
        json.value("object", object);
        json.flag("seen", seen);
        json.openLine("casts_in_views", '[');
        for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
            const auto first = plan.casters.begin() + plan.views[i].casters.first;
            const auto moving =
                first + (plan.views[i].contents.kept_layer == kNoIndex ? 0 : plan.views[i].casters.still);
            if (std::binary_search(first, moving, object) ||
                std::binary_search(moving, first + plan.views[i].casters.count, object)) {
                json.value({}, i);
            }
        }
        json.closeLine(']');
        json.closeLine('}');
    }
    json.close(']');
}

} // namespace

std::string_view nameOf(OutcomeKind kind)
{
    switch (kind) {
    case OutcomeKind::ok:
        return "ok";
    case OutcomeKind::fallback:
        return "fallback";
    case OutcomeKind::no_shadow_wanted:
        return "no_shadow_wanted";
    case OutcomeKind::no_receiver:
        return "no_receiver";
    case OutcomeKind::no_caster:
        return "no_caster";
    case OutcomeKind::degenerate:
        return "degenerate";
    case OutcomeKind::refused:
        return "refused";
    case OutcomeKind::atlas_full:
        return "atlas_full";
    }
    return "?";
}

std::string toJson(const Plan& plan)
{
    JsonWriter json;
    json.open({}, '{');
    json.value("frame", plan.frame);
    const std::span<const ResolvedOptions> options = plan.options ? *plan.options : noOptions();
    writeTechnique(json, options.front().technique());
    json.open("pages", '[');
    for (const MapPages& pages : plan.pages) {
        writePages(json, pages);
    }
    json.close(']');
    json.value("mask_layers", plan.mask_layers);
    writeFade(json, options.front());
    writeFurtherOptions(json, options.subspan(1));
    json.open("lights", '[');
    for (std::uint32_t i = 0; i < plan.lights.size(); ++i) {
        writeLight(json, plan, i);
    }
    json.close(']');
    json.open("views", '[');
    for (const View& view : plan.views) {
        writeView(json, plan, view);
    }
    json.close(']');
    writeObjects(json, plan);
    json.close('}');
    return json.take();
}

} // namespace gnomon
