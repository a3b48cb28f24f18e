// SPDX-License-Identifier: Apache-2.0
// One light after the other: is it fit to be planned, where does it stand, how is it divided, what matters to each
// slice, how is that put into a map, and does what the map holds still do.
#include "atlas/layers.h"
#include "camera_view.h"
#include "depth_range.h"
#include "depth_tilt.h"
#include "drawn_maps.h"
#include "fit/projection.h"
#include "motion/motion.h"
#include "motion/sun_steps.h"
#include "partition/partition.h"
#include "region.h"

#include <gnomon/planner.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace gnomon {
namespace {

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

[[maybe_unused]] bool usable(const StepOptions& options)
{
    return options.angle_rad >= 0.0001 && options.angle_rad <= 0.5 && options.interval_s >= 0.01 &&
           options.interval_s <= 86400.0 && options.band >= 0.01 && options.band <= 1.0;
}

/// One position of a light, and where the maps of its slices go.
struct Position {
    std::uint32_t light = 0; // index into Frame::lights
    Light at;                // the light, shining from there
    SunPosition sun = SunPosition::only;
    bool read = true; // in this frame
    TexelPart part = TexelPart::whole;
    std::uint32_t first_layer = 0; // its maps' layers follow each other, so that one pass can draw them
    std::uint32_t first_kept = kNoIndex;
    std::uint32_t count = 1; // of maps
};

/// Of what becomes of a light's slices, the highest is what is said of the light.
int rank(OutcomeKind kind)
{
    constexpr OutcomeKind kUpwards[] = {OutcomeKind::no_receiver, OutcomeKind::no_caster, OutcomeKind::ok,
                                        OutcomeKind::fallback};
    return static_cast<int>(std::find(std::begin(kUpwards), std::end(kUpwards), kind) - std::begin(kUpwards));
}

} // namespace

struct Planner::Impl {
    PlanOptions options;
    PartitionFunction partition = nullptr;
    bool fits_on_gpu = false;
    FitFunction fit = nullptr;
    const MotionTraits* motion = nullptr;
    const FilterTraits* filter = nullptr;
    double border_texels = 0.0;

    Plan plan;
    DrawnMaps drawn;
    SunCourses suns;
    std::uint64_t frames = 0; // planned so far: whose turn it is

    CameraView view;
    Region region;
    LayerAtlas atlas;
    std::vector<Slice> slices;
    std::vector<std::uint32_t> all_receivers; // of the scene, where a steady map measures level depth

    void look(const Frame& frame);
    Warp warpOf(const LightSpace& space) const;
    Outcome check(const Light& light) const
    {
        if (!light.casts_shadow)
            return {OutcomeKind::no_shadow_wanted, "the light casts no shadow"};
        if (const auto reason = refusal(light.type, options.technique))
            return {OutcomeKind::refused, *reason};
        return checkLight(light);
    }

    bool pairs(const Light& light) const
    {
        return motion != nullptr && paired(motion->stepping) && light.type == LightType::directional;
    }
    bool keeps(const Light& light) const
    {
        const bool steps = motion->stepping != Stepping::none && light.type == LightType::directional;
        if (fits_on_gpu) // every map is another one in each frame
            return false;
        return options.keep_still == KeepStill::always || (options.keep_still == KeepStill::automatic && steps);
    }

    void planLight(const Frame& frame, std::uint32_t index);
    std::uint32_t followSun(const Frame& frame, const Light& light, SunSteps& steps);
    std::optional<Position> takeRoom(const Light& light);
    void planPositions(const Frame& frame, const Position& room, std::uint32_t earlier_slot, LightPlan& planned);
    void planPosition(const Frame& frame, const Position& position, std::optional<Outcome>& best);
    void listCascades(std::uint32_t base, std::uint32_t first_layer);
    Outcome planView(const Frame& frame, const Position& position, std::uint32_t slice_index);
    void decideRedraws(const Frame& frame);
};

Planner::Planner(const PlanOptions& options) : impl_(std::make_unique<Impl>())
{
    assert(options.map_size >= 16 && options.map_size <= 16384);
    assert(options.max_layers >= 1 && options.max_layers <= 2048);
    assert(options.border_texels >= 0.0 && options.border_texels <= 64.0);
    assert(options.fade >= 0.0 && options.fade <= 1.0);
    assert(usable(options.cascades));
    assert(usable(options.steps));
    Impl& s = *impl_;
    s.options = options;
    s.partition = partitionFunction(options.technique.partition);
    s.fits_on_gpu = partitionFitsOnGpu(options.technique.partition);
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
    impl_->drawn.forget();
}

const PlanOptions& Planner::options() const
{
    return impl_->options;
}

const Plan& Planner::plan(const Frame& frame)
{
    assert(frame.objects != nullptr);
    Impl& s = *impl_;
    Plan& plan = s.plan;
    plan.frame = frame.index;
    plan.technique = s.options.technique;
    plan.lights.clear();
    plan.views.clear();
    plan.casters.clear();
    plan.pages[0].kept_layers = 0;
    plan.mask_layers = (static_cast<std::uint32_t>(frame.lights.size()) + 3) / 4;

    s.atlas.begin(s.options.map_size, s.options.max_layers);
    s.suns.begin();
    s.look(frame);
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light)
        s.planLight(frame, light);
    s.suns.end();
    ++s.frames;
    const std::uint32_t kept_layers = plan.pages[0].kept_layers;
    plan.pages[0] = s.atlas.size();
    plan.pages[0].kept_layers = kept_layers;
    plan.map_count = 2 * (plan.pages[0].layers * 2 + kept_layers) + 2;
    s.decideRedraws(frame);
    return plan;
}

void Planner::Impl::look(const Frame& frame)
{
    view.look(frame, options.max_distance_m, plan.receivers);
    plan.fade_end_m = options.max_distance_m;
    plan.fade_begin_m = options.max_distance_m * (1.0 - options.fade);
    plan.cascades = options.cascades;
    plan.border_texels = border_texels;
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
        if (frame.objects->alive(i) && frame.objects->flags(i).receives)
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

/// Where a sun stands for its maps; returns the slot of its earlier position.
std::uint32_t Planner::Impl::followSun(const Frame& frame, const Light& light, SunSteps& steps)
{
    const bool stepping = motion != nullptr && motion->stepping != Stepping::none;
    if (!stepping || light.type != LightType::directional || checkLight(light).kind != OutcomeKind::ok)
        return 0;
    const SunCourse& course = suns.follow(light, frame.time_s, motion->stepping, options.steps);
    steps = course.steps();
    // By turns of the slots, not of the positions: then after a step too the frame before has read the other one, or
    // the one whose weight was next to nothing.
    steps.read = (frames & 1) == course.earlierSlot() ? SunPosition::earlier : SunPosition::later;
    return course.earlierSlot();
}

/// Depends on the options and the light's type alone, so that tiles last. None when the atlas is full.
std::optional<Position> Planner::Impl::takeRoom(const Light& light)
{
    const auto count = static_cast<std::uint32_t>(slices.size()) * (fits_on_gpu ? options.cascades.count : 1);
    Position room;
    room.count = count;
    room.part = options.paired_maps ? TexelPart::first : TexelPart::whole;
    const std::optional<std::uint32_t> first_layer =
        atlas.take(pairs(light) && !options.paired_maps ? 2 * count : count);
    if (!first_layer)
        return std::nullopt;
    room.first_layer = *first_layer;
    const std::uint32_t kept = pairs(light) ? 2 * count : count;
    if (keeps(light) && kept <= options.max_layers - std::min(plan.pages[0].kept_layers, options.max_layers)) {
        room.first_kept = plan.pages[0].kept_layers;
        plan.pages[0].kept_layers += kept;
    }
    return room;
}

void Planner::Impl::planLight(const Frame& frame, std::uint32_t index)
{
    const Light& light = frame.lights[index];
    LightPlan planned;
    planned.first_view = static_cast<std::uint32_t>(plan.views.size());
    planned.mask_layer = index / 4;
    planned.mask_channel = index % 4;
    planned.outcome = check(light);
    const std::uint32_t earlier_slot = followSun(frame, light, planned.steps);
    std::optional<Position> room;
    if (planned.outcome.kind == OutcomeKind::ok) {
        slices.clear();
        partition({light, view, options.cascades}, slices);
        room = takeRoom(light);
        if (!room)
            planned.outcome = {OutcomeKind::atlas_full, "the atlas has no layer left for this light"};
        else if (view.outcome.kind != OutcomeKind::ok)
            planned.outcome = view.outcome;
        else if (plan.receivers.empty())
            planned.outcome = {OutcomeKind::no_receiver, "the camera sees nothing that receives shadow"};
    }
    if (planned.outcome.kind == OutcomeKind::ok) {
        room->light = index;
        room->at = light;
        planPositions(frame, *room, earlier_slot, planned);
    }
    planned.view_count = static_cast<std::uint32_t>(plan.views.size()) - planned.first_view;
    plan.lights.push_back(planned);
}

/// A position keeps its slot, that is its tiles or their part, for as long as the sun has it.
void Planner::Impl::planPositions(const Frame& frame, const Position& room, std::uint32_t earlier_slot,
                                  LightPlan& planned)
{
    const SunSteps& steps = planned.steps;
    const bool pair = pairs(room.at);
    std::optional<Outcome> best;
    for (const bool later : {false, true}) {
        if (later && !steps.paired)
            break;
        Position position = room;
        if (steps.stepping)
            position.at.direction_ws = later ? steps.later_ws : steps.earlier_ws;
        if (steps.paired)
            position.sun = later ? SunPosition::later : SunPosition::earlier;
        position.read = !steps.alternate || position.sun == steps.read;
        if (pair) {
            const std::uint32_t slot = later ? 1 - earlier_slot : earlier_slot;
            position.first_kept = room.first_kept == kNoIndex ? kNoIndex : room.first_kept + slot * room.count;
            if (options.paired_maps)
                position.part = slot == 0 ? TexelPart::first : TexelPart::second;
            else
                position.first_layer += slot * room.count;
        }
        planPosition(frame, position, best);
    }
    planned.outcome = *best;
}

/// A slice without receivers or casters needs no map; the light has one when any slice does.
void Planner::Impl::planPosition(const Frame& frame, const Position& position, std::optional<Outcome>& best)
{
    slices.clear();
    partition({position.at, view, options.cascades}, slices);
    for (std::uint32_t i = 0; i < slices.size(); ++i) {
        const Outcome outcome = planView(frame, position, i);
        if (!best || rank(outcome.kind) > rank(best->kind))
            best = outcome;
        if (fits_on_gpu && outcome.hasMap())
            listCascades(static_cast<std::uint32_t>(plan.views.size()) - 1, position.first_layer);
    }
}

/// Of a base map, one view for each cascade that the GPU will fit to a part of it.
void Planner::Impl::listCascades(std::uint32_t base, std::uint32_t first_layer)
{
    plan.views[base].gpu_cascade = 0;
    for (std::uint32_t i = 1; i < options.cascades.count; ++i) {
        View cascade = plan.views[base];
        cascade.gpu_cascade = i;
        cascade.tile = atlas.tile(first_layer + i);
        plan.views.push_back(cascade);
    }
}

Outcome Planner::Impl::planView(const Frame& frame, const Position& position, std::uint32_t slice_index)
{
    const Slice& slice = slices[slice_index];

    LightSpace space = lightSpaceOf(position.at, slice.axis_ws, slice.half_angle_rad, view.scene_ws);
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
    made.light = position.light;
    made.sun = position.sun;
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
    made.tile = atlas.tile(position.first_layer + slice_index);
    made.part = position.part;
    made.redraw = position.read;
    if (position.first_kept != kNoIndex)
        made.kept_layer = position.first_kept + slice_index;
    made.first_caster = first_caster;
    made.caster_count = static_cast<std::uint32_t>(casters.size());
    plan.views.push_back(made);
    return warp.outcome;
}

void Planner::Impl::decideRedraws(const Frame& frame)
{
    drawn.begin(plan, *frame.objects);
    for (View& made : plan.views) {
        const std::uint32_t kept_layer = std::exchange(made.kept_layer, kNoIndex);
        if (made.redraw && made.gpu_cascade == kNoIndex) // it is read, and known beforehand
            drawn.decide(made, kept_layer, std::span(plan.casters).subspan(made.first_caster, made.caster_count),
                         *frame.objects);
    }
}

} // namespace gnomon
