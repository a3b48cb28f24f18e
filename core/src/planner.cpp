// SPDX-License-Identifier: Apache-2.0
// One light after the other: is it fit to be planned, how is it divided, what matters to each slice, how is that put
// into a map, and does the map of the last frame still hold.
#include "atlas/layers.h"
#include "camera_view.h"
#include "depth_range.h"
#include "depth_tilt.h"
#include "fit/projection.h"
#include "motion/motion.h"
#include "partition/partition.h"
#include "region.h"

#include <gnomon/planner.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace gnomon {
namespace {

bool sameTile(const Tile& a, const Tile& b)
{
    return a.layer == b.layer && a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool sameSize(const AtlasSize& a, const AtlasSize& b)
{
    return a.width == b.width && a.height == b.height && a.layers == b.layers;
}

[[maybe_unused]] bool usable(const CascadeOptions& options)
{
    if (options.count < 1 || options.count > kMaxCascades || !(options.lambda >= 0.0 && options.lambda <= 1.0) ||
        !(options.blend >= 0.0 && options.blend <= 0.5))
        return false;
    double last_m = 0.0;
    for (std::uint32_t i = 0; options.explicitEnds() && i + 1 < options.count; ++i) {
        if (!(options.ends_m[i] > last_m))
            return false;
        last_m = options.ends_m[i];
    }
    return true;
}

constexpr std::string_view kUnwarped =
    "a warped map has no texels of one size to move in whole steps, so it is drawn without warp";

} // namespace

struct Planner::Impl {
    PlanOptions options;
    PartitionFunction partition = nullptr;
    FitFunction fit = nullptr;
    const MotionTraits* motion = nullptr;
    const FilterTraits* filter = nullptr;
    double border_texels = 0.0;

    std::array<Plan, 2> plans; // this one and the last
    std::size_t current = 0;
    bool have_last = false;
    std::uint64_t last_version = 0;
    std::uint64_t last_identity = 0;

    CameraView view;
    Region region;
    LayerAtlas atlas;
    std::vector<Slice> slices;
    std::vector<std::uint32_t> all_receivers; // of the scene, where a steady map measures level depth

    void look(const Frame& frame, Plan& plan);
    Warp warpOf(const LightSpace& space) const;
    Outcome check(const Light& light) const
    {
        if (!light.casts_shadow)
            return {OutcomeKind::no_shadow_wanted, "the light casts no shadow"};
        if (const auto reason = refusal(light.type, options.technique))
            return {OutcomeKind::refused, *reason};
        return checkLight(light);
    }

    void planLight(const Frame& frame, std::uint32_t index, Plan& plan);
    Outcome planView(const Frame& frame, std::uint32_t light, const Slice& slice, std::uint32_t layer, Plan& plan);
    void decideRedraws(const Frame& frame, Plan& plan, const Plan& last) const;
    bool stillHolds(const View& view, const Plan& plan, const Plan& last, const ObjectSet& objects) const;
};

Planner::Planner(const PlanOptions& options) : impl_(std::make_unique<Impl>())
{
    assert(options.map_size >= 16 && options.map_size <= 16384);
    assert(options.max_layers >= 1 && options.max_layers <= 2048);
    assert(options.border_texels >= 0.0 && options.border_texels <= 64.0);
    assert(options.fade >= 0.0 && options.fade <= 1.0);
    assert(usable(options.cascades));
    Impl& s = *impl_;
    s.options = options;
    s.partition = partitionFunction(options.technique.partition);
    s.fit = fitFunction(options.technique.fit);
    s.motion = motionTraits(options.technique.motion);
    s.filter = filterTraits(options.technique.filter);
    s.border_texels = usableBorder(options.border_texels, options.map_size);
}

Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

void Planner::reset()
{
    impl_->have_last = false;
}

const PlanOptions& Planner::options() const
{
    return impl_->options;
}

const Plan& Planner::plan(const Frame& frame)
{
    assert(frame.objects != nullptr);
    Impl& s = *impl_;
    const Plan& last = s.plans[s.current];
    s.current = 1 - s.current;
    Plan& plan = s.plans[s.current];
    plan.frame = frame.index;
    plan.technique = s.options.technique;
    plan.lights.clear();
    plan.views.clear();
    plan.casters.clear();
    plan.mask_layers = (static_cast<std::uint32_t>(frame.lights.size()) + 3) / 4;

    s.atlas.begin(s.options.map_size, s.options.max_layers);
    s.look(frame, plan);
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light)
        s.planLight(frame, light, plan);
    plan.atlas = s.atlas.size();
    s.decideRedraws(frame, plan, last);

    s.have_last = true;
    s.last_version = frame.objects->version();
    s.last_identity = frame.objects->identity();
    return plan;
}

void Planner::Impl::look(const Frame& frame, Plan& plan)
{
    view.look(frame, options.max_distance_m, plan.receivers);
    plan.fade_end_m = options.max_distance_m;
    plan.fade_begin_m = options.max_distance_m * (1.0 - options.fade);
    const bool steady = motion != nullptr && motion->steady;
    if (view.outcome.kind == OutcomeKind::ok && !plan.receivers.empty()) {
        if (steady)
            view.boundDepths(frame.camera, options.max_distance_m);
        else if (partitionMeasures(options.technique.partition))
            view.measureDepths(*frame.objects, plan.receivers);
    }
    all_receivers.clear();
    const bool levels = steady && options.level_depth && filter != nullptr && filter->filterable;
    for (std::uint32_t i = 0; levels && i < frame.objects->size(); ++i)
        if (frame.objects->flags(i).receives)
            all_receivers.push_back(i);
}

Warp Planner::Impl::warpOf(const LightSpace& space) const
{
    if (!motion->steady)
        return fit({space, region.outline(), region.body().points(), region.body().faceSizes(), view,
                    strongestWarp(border_texels, options.map_size)});
    Warp none;
    if (options.technique.fit != Fit::uniform)
        none.outcome = {OutcomeKind::fallback, kUnwarped};
    return none;
}

void Planner::Impl::planLight(const Frame& frame, std::uint32_t index, Plan& plan)
{
    LightPlan light;
    light.first_view = static_cast<std::uint32_t>(plan.views.size());
    light.mask_layer = index / 4;
    light.mask_channel = index % 4;
    light.outcome = check(frame.lights[index]);
    std::optional<std::uint32_t> first_layer;
    if (light.outcome.kind == OutcomeKind::ok) {
        slices.clear();
        partition({frame.lights[index], view, options.cascades}, slices);
        first_layer = atlas.take(static_cast<std::uint32_t>(slices.size()));
        if (!first_layer)
            light.outcome = {OutcomeKind::atlas_full, "the atlas has no layer left for this light"};
        else if (view.outcome.kind != OutcomeKind::ok)
            light.outcome = view.outcome;
        else if (plan.receivers.empty())
            light.outcome = {OutcomeKind::no_receiver, "the camera sees nothing that receives shadow"};
    }
    if (light.outcome.kind == OutcomeKind::ok) {
        // A slice without receivers or casters needs no map; the light has one when any slice does.
        Outcome best;
        for (std::uint32_t i = 0; i < slices.size(); ++i) {
            const Outcome outcome = planView(frame, index, slices[i], *first_layer + i, plan);
            const bool more = i == 0 || (outcome.hasMap() && !best.hasMap()) ||
                              (outcome.kind == OutcomeKind::fallback && best.kind == OutcomeKind::ok);
            if (more)
                best = outcome;
        }
        light.outcome = best;
    }
    light.view_count = static_cast<std::uint32_t>(plan.views.size()) - light.first_view;
    plan.lights.push_back(light);
}

Outcome Planner::Impl::planView(const Frame& frame, std::uint32_t light, const Slice& slice, std::uint32_t layer,
                                Plan& plan)
{
    LightSpace space = lightSpaceOf(frame.lights[light], slice.axis_ws, slice.half_angle_rad, view.scene_ws);
    if (options.level_depth && filter->filterable)
        space.depth_ws = levelDepth(space, *frame.objects, motion->steady ? all_receivers : plan.receivers);
    const RegionInput input{space, slice, view, *frame.objects, plan.receivers, filter->filterable};
    if (const Outcome found = region.gatherReceivers(input); found.kind != OutcomeKind::ok)
        return found;
    const Warp warp = warpOf(space);
    // Unwarped, the rectangle of the receivers' boxes may be the smaller one.
    const LightRect rect = warp.warped() ? rectOf(warp, region.outline()) : region.rect();
    const double least_size = space.perspective ? 1e-4 : 1e-3 + view.pad_m;
    const MapFrame shown =
        motion->move(rect, {space, frame.camera, view, slice, least_size, options.map_size, border_texels});

    View made;
    made.light = light;
    made.slice = slice.depth;
    made.parallel = !space.perspective;
    made.fit = reportOf(warp, shown, region.outline());
    made.texel_xy_m = made.fit.coarsest_texel;
    made.texel_m = std::max(made.texel_xy_m.x, made.texel_xy_m.y);
    const std::uint32_t first_caster = static_cast<std::uint32_t>(plan.casters.size());
    const CasterReach reach{motion->steady ? LightRect{shown.centre - shown.half, shown.centre + shown.half}
                                           : region.rect(),
                            borderReach(warp, made.fit, border_texels, options.map_size),
                            farthestCaster(region, space, motion->steady), motion->steady};
    const Outcome found = region.gatherCasters(input, reach, plan.casters);
    if (found.kind != OutcomeKind::ok)
        return found;
    const std::span casters = std::span(plan.casters).subspan(first_caster);

    // Between a placed light and its near distance nothing casts, so there the rasteriser cuts.
    made.clamp_near = filter->clamps_near && !space.perspective;
    const DepthRange range = depthRangeOf({region, space, made.clamp_near, motion->steady, made.texel_m, view.pad_m});
    made.clip_from_world = clipFromWorld(space, warp, shown, range.near_m, range.far_m);
    made.orthographic = !space.perspective && !warp.warped();
    const double place_m = lightPlaceOf(region, space, range.near_m);
    const glm::dvec3 centre_ws = region.centre_ws();
    made.light_place_ws =
        space.perspective ? space.origin_ws : centre_ws + space.forward_ws * (place_m - space.coordinates(centre_ws).z);
    made.metric.near_m = range.near_m - place_m;
    made.metric.far_m = range.far_m - place_m;
    const glm::dvec4 depth(space.depth_ws, -glm::dot(space.depth_ws, space.origin_ws) - range.near_m);
    made.metric.metric_ws = depth / (range.far_m - range.near_m);
    made.tile = atlas.tile(layer);
    made.first_caster = first_caster;
    made.caster_count = static_cast<std::uint32_t>(casters.size());
    plan.views.push_back(made);
    return warp.outcome;
}

void Planner::Impl::decideRedraws(const Frame& frame, Plan& plan, const Plan& last) const
{
    const bool comparable = have_last && last_identity == frame.objects->identity() && sameSize(plan.atlas, last.atlas);
    for (View& made : plan.views)
        made.redraw = !(comparable && stillHolds(made, plan, last, *frame.objects));
}

/// A tile's content depends on the view and its casters alone, so whose light it was last time does not matter.
bool Planner::Impl::stillHolds(const View& made, const Plan& plan, const Plan& last, const ObjectSet& objects) const
{
    const auto same = [&](const View& old) {
        return sameTile(old.tile, made.tile) && old.clip_from_world == made.clip_from_world &&
               old.metric.metric_ws == made.metric.metric_ws && old.orthographic == made.orthographic &&
               old.clamp_near == made.clamp_near && old.caster_count == made.caster_count;
    };
    const auto old = std::find_if(last.views.begin(), last.views.end(), same);
    if (old == last.views.end())
        return false;
    const std::span<const std::uint64_t> changes = objects.allChanges();
    const std::span now = std::span(plan.casters).subspan(made.first_caster, made.caster_count);
    const std::span then = std::span(last.casters).subspan(old->first_caster, old->caster_count);
    return std::equal(now.begin(), now.end(), then.begin()) &&
           std::none_of(now.begin(), now.end(), [&](std::uint32_t c) { return changes[c] > last_version; });
}

} // namespace gnomon
