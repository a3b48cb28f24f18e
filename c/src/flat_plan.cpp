// SPDX-License-Identifier: Apache-2.0
#include "flat_plan.h"

#include <gnomon/pack/caster_rows.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/map_attachments.h>
#include <gnomon/plan_views.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>

namespace gnomon::c {
namespace {

static_assert(static_cast<int>(OutcomeKind::fallback) == GNOMON_FALLBACK &&
              static_cast<int>(OutcomeKind::no_shadow_wanted) == GNOMON_NO_SHADOW_WANTED &&
              static_cast<int>(OutcomeKind::no_receiver) == GNOMON_NO_RECEIVER &&
              static_cast<int>(OutcomeKind::no_caster) == GNOMON_NO_CASTER &&
              static_cast<int>(OutcomeKind::degenerate) == GNOMON_DEGENERATE &&
              static_cast<int>(OutcomeKind::refused) == GNOMON_OPTIONS_REFUSED &&
              static_cast<int>(OutcomeKind::atlas_full) == GNOMON_ATLAS_FULL);
static_assert(static_cast<int>(SunPosition::earlier) == GNOMON_EARLIER &&
              static_cast<int>(SunPosition::later) == GNOMON_LATER &&
              static_cast<int>(TexelPart::first) == GNOMON_FIRST &&
              static_cast<int>(TexelPart::second) == GNOMON_SECOND);
static_assert(static_cast<int>(pack::FramePassKind::bounds) == GNOMON_PASS_BOUNDS &&
              static_cast<int>(pack::FramePassKind::spread) == GNOMON_PASS_SPREAD &&
              static_cast<int>(pack::FramePassKind::history) == GNOMON_PASS_HISTORY &&
              static_cast<int>(pack::FramePassKind::blur) == GNOMON_PASS_BLUR);
static_assert(kNoIndex == GNOMON_NO_INDEX && std::extent_v<decltype(GnomonView::layers)> == kMaxDepthLayers);
constexpr std::array kPassNames{"bounds", "maps", "mask", "spread", "volumes", "history", "converge", "blur"};

/// Rounds where the numbers are floats.
template <class Vector, class Number, std::size_t kCount>
void put(const Vector& from, Number (&to)[kCount])
{
    std::transform(glm::value_ptr(from), glm::value_ptr(from) + kCount, to,
                   [](auto number) { return static_cast<Number>(number); });
}

constexpr std::uint32_t flag(bool value)
{
    return value ? 1 : 0;
}

template <class Enum>
constexpr std::uint32_t number(Enum value)
{
    return static_cast<std::uint32_t>(value);
}

void putSteps(const SunSteps& steps, GnomonLightPlan& out)
{
    out.steps_stepping = flag(steps.stepping);
    out.steps_paired = flag(steps.paired);
    out.steps_smooth = flag(steps.smooth);
    out.steps_alternate = flag(steps.alternate);
    out.steps_read = number(steps.read);
    put(steps.earlier_ws, out.steps_earlier_ws);
    put(steps.later_ws, out.steps_later_ws);
    out.steps_share = steps.share;
    out.steps_band = steps.band;
    out.steps_edge = steps.edge;
}

GnomonLightPlan lightOf(const LightPlan& light, Texts& texts)
{
    GnomonLightPlan out{};
    out.outcome = number(light.outcome.kind);
    out.has_map = flag(light.outcome.hasMap());
    out.outcome_name = texts(nameOf(light.outcome.kind));
    out.reason = texts(light.outcome.reason);
    out.first_view = light.first_view;
    out.view_count = light.view_count;
    out.mask_layer = light.mask_layer;
    out.mask_channel = light.mask_channel;
    out.mask_coloured = flag(light.mask_coloured);
    out.options = light.options;
    out.halved = light.halved;
    out.waited = light.waited;
    out.first_object_id = light.first_object_id;
    out.first_volume = light.first_volume;
    out.volume_count = light.volume_count;
    out.left_out = light.left_out;
    putSteps(light.steps, out);
    out.sample_joined = flag(light.sample.joined);
    put(light.sample.position_ws, out.sample_position_ws);
    put(light.sample.direction_ws, out.sample_direction_ws);
    out.sample_number = light.sample.number;
    out.choice_made = flag(light.choice.made);
    out.choice_partition = texts(nameOf(light.choice.partition));
    out.choice_rates = texts(nameOf(light.choice.rates));
    out.choice_reason = texts(light.choice.reason);
    out.choice_texels_per_pixel = light.choice.texels_per_pixel;
    out.choice_error = light.choice.error;
    out.choice_other_error = light.choice.other_error;
    out.choice_time_ms = light.choice.time_ms;
    out.choice_halvings = light.choice.halvings;
    return out;
}

void putProjection(const ViewProjection& from, const glm::dmat4& world_from_eye, GnomonView& out)
{
    out.caster_rows = pack::casterRowCount(from.orthographic);
    out.orthographic = flag(from.orthographic);
    out.clamp_near = flag(from.clamp_near);
    out.parallel = flag(from.parallel);
    out.paraboloid = flag(from.paraboloid);
    out.gpu_cascade = from.gpu_cascade;
    put(from.clip_from_world, out.clip_from_world);
    put(from.clip_from_world, out.clip_from_world_f);
    put(from.clip_from_world * world_from_eye, out.clip_from_eye_f);
    put(from.metric.metric_ws, out.metric_ws);
    put(from.metric.metric_ws, out.metric_ws_f);
    put(from.metric.metric_ws * world_from_eye, out.metric_eye_f); // a row vector
    out.near_m = from.metric.near_m;
    out.far_m = from.metric.far_m;
    put(from.light_place_ws, out.light_place_ws);
    out.texel_m = from.texel_m;
    put(from.texel_xy_m, out.texel_xy_m);
    out.light_reach = from.light_reach;
    put(from.grid_move_texels, out.grid_move_texels);
}

void putContents(const View& view, GnomonView& out)
{
    const ViewContents& from = view.contents;
    out.presumes = from.presumes;
    out.makes = from.makes;
    out.kept_presumes = from.kept_presumes;
    out.kept_makes = from.kept_makes;
    out.ids_key = from.ids_key;
    out.texels_to_draw = texelsToDraw(view);
    out.redraw = flag(from.redraw);
    out.redraw_kept = flag(from.redraw_kept);
    out.kept_layer = from.kept_layer;
    out.kept_map_index = from.kept_map.index;
    out.kept_map_generation = from.kept_map.generation;
    out.dirty_x = from.dirty.x;
    out.dirty_y = from.dirty.y;
    out.dirty_width = from.dirty.width;
    out.dirty_height = from.dirty.height;
    out.waited = from.waited;
}

void putServes(const ViewServes& from, GnomonView& out)
{
    out.serves_sun = number(from.sun);
    out.serves_layered = flag(from.layered);
    out.slice_across = flag(from.slice.across);
    put(from.slice.axis, out.slice_axis);
    put(from.slice.over, out.slice_over);
    out.slice_begin_m = from.slice.begin_m;
    out.slice_end_m = from.slice.end_m;
    out.slice_blend_m = from.slice.blend_m;
    put(from.sector.x, out.sector_x);
    put(from.sector.y, out.sector_y);
    put(from.sector.w, out.sector_w);
    out.serves_faded_in = from.faded_in;
    out.serves_rim = from.rim;
    for (std::size_t i = 0; i < from.layers.size(); ++i) {
        out.layers[i][0] = from.layers[i].near;
        out.layers[i][1] = from.layers[i].far;
    }
}

void putAttachments(const Plan& plan, const View& view, Texts& texts, GnomonView& out)
{
    const pack::MapAttachments made = pack::mapAttachments(plan, view);
    out.depth_format = texts(nameOf(made.depth));
    out.colour_format = texts(made.colour ? nameOf(*made.colour) : "");
    out.clear_depth = made.clear_depth;
    out.clear_colour = made.clear_colour;
    out.samples = made.samples;
    out.write_depth = flag(made.write_depth);
    out.need_fragment_shader = flag(made.needFragmentShader());
    out.channels = made.colour ? pack::channelsOfPart(*made.colour, view.place.part) : 0;
}

GnomonView viewOf(const Plan& plan, const View& view, const glm::dmat4& world_from_eye, Texts& texts)
{
    GnomonView out{};
    out.light = view.light;
    out.options = optionsIndexOf(plan, view);
    out.first_caster = view.casters.first;
    out.caster_count = view.casters.count;
    out.still_casters = view.casters.still;
    putProjection(view.projection, world_from_eye, out);
    out.map_index = view.place.map.index;
    out.map_generation = view.place.map.generation;
    out.tile_layer = view.place.tile.layer;
    out.tile_x = view.place.tile.x;
    out.tile_y = view.place.tile.y;
    out.tile_width = view.place.tile.width;
    out.tile_height = view.place.tile.height;
    out.tile_part = number(view.place.part);
    putContents(view, out);
    putServes(view.serves, out);
    out.fit_strength = view.fit.strength;
    put(view.fit.finest_texel, out.finest_texel);
    put(view.fit.coarsest_texel, out.coarsest_texel);
    putAttachments(plan, view, texts, out);
    return out;
}

GnomonPages pagesOf(const MapPages& pages, const ResolvedOptions& options, Texts& texts)
{
    GnomonPages out{};
    out.width = pages.width;
    out.height = pages.height;
    out.layers = pages.layers;
    out.kept_layers = pages.kept_layers;
    out.levels = pages.width > 0 ? pack::mipLevels(options, pages.width, pages.height) : 1;
    out.waiting_lights = pages.waiting_lights;
    out.waiting_maps = pages.waiting_maps;
    out.longest_wait = pages.longest_wait;
    out.wanted_texels = pages.wanted_texels;
    out.given_texels = pages.given_texels;
    out.drawn_texels = pages.drawn_texels;
    out.margin_texels = tileMarginTexels(options.reach_texels());
    out.reach_texels = options.reach_texels();
    out.fade_begin_m = options.fadeBegin_m();
    out.fade_end_m = options.fadeEnd_m();
    out.filter = texts(nameOf(options.filter()));
    out.format = texts(nameOf(options.format()));
    if (options.traits().integrates_light && pages.width > 0) {
        out.blocks_size = pack::blocksExtent({pages.width, pages.height}).x;
        out.blocks_levels = pack::blockLevels({pages.width, pages.height});
    }
    return out;
}

/// Everything but the lists of structs.
GnomonPlan planOf(const Plan& plan, const FlatPlan& flat)
{
    const auto count = [](const auto& list) {
        return static_cast<std::uint32_t>(list.size());
    };
    GnomonPlan out{};
    out.frame = plan.frame;
    out.number = plan.number;
    out.planner = plan.planner;
    out.cut = flag(plan.cut);
    out.light_count = count(flat.lights);
    out.view_count = count(flat.views);
    out.options_count = count(flat.pages);
    out.pass_count = count(flat.passes);
    out.map_count = plan.map_count;
    out.mask_layers = plan.mask_layers;
    out.mask_channels = maskChannelCount(plan);
    out.caster_count = count(plan.casters);
    out.receiver_count = count(plan.receivers);
    out.object_id_count = count(plan.object_ids);
    out.moved_count = count(flat.moved);
    out.casters = plan.casters.data();
    out.receivers = plan.receivers.data();
    out.object_ids = plan.object_ids.data();
    out.moved = flat.moved.data();
    return out;
}

} // namespace

const char* Texts::operator()(std::string_view text)
{
    auto found = kept_.find(text);
    if (found == kept_.end()) {
        found = kept_.emplace(text).first;
    }
    return found->c_str();
}

void flatten(const Plan& plan, FlatPlan& out)
{
    out.lights.clear();
    for (const LightPlan& light : plan.lights) {
        out.lights.push_back(lightOf(light, out.texts));
    }
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), plan.made_for.camera.eye_ws);
    out.views.clear();
    for (const View& view : plan.views) {
        out.views.push_back(viewOf(plan, view, world_from_eye, out.texts));
    }
    out.pages.clear();
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        out.pages.push_back(pagesOf(plan.pages[i], (*plan.options)[i], out.texts));
    }
    pack::listFramePasses(plan, out.listed);
    out.passes.clear();
    for (const pack::FramePass& pass : out.listed) {
        out.passes.push_back({number(pass.kind), pass.options, kPassNames[number(pass.kind)]});
    }
    out.moved.clear();
    for (const Aabb& box : plan.moved_ws) {
        GnomonBounds& bounds = out.moved.emplace_back();
        put(box.min, bounds.min);
        put(box.max, bounds.max);
    }
    out.plan = planOf(plan, out);
}

} // namespace gnomon::c
