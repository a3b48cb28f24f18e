// SPDX-License-Identifier: Apache-2.0
// Cascades of a light that take turns each by itself: planned with room around what is seen, and kept for as long as
// that still lies in what they were planned for.
#include "planner_impl.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Share of a slice in which none of the points in sight is.
constexpr double kLeastPart = 0.01;

} // namespace

/// Does the light have maps that wait without the others? Its frustums and those of the plan before are of one kind.
bool Planner::Impl::turnsByCascade(const Light& light) const
{
    const Recipe& recipe = setups[light.options].recipe;
    return recipe.turnsByCascade() && !recipe.converges() && !recipe.steps(light);
}

/// What the camera would see with room around its picture.
void Planner::Impl::lookWide(const Frame& frame, Setup& setup)
{
    Setup::Wide& wide = setup.wide;
    if (wide.looked) {
        return;
    }
    wide.looked = true;
    const ShadowOptions& options = setup.recipe.options;
    const double room = options.cascades.room;
    wide.frame = frame;
    wide.frame.camera = widened(frame.camera, room);
    wide.camera.look(wide.frame, options.max_distance_m * (1.0 + room), wide.receivers);
    wide.camera.near_m = setup.camera.near_m;
    wide.camera.far_m = widenedFar_m(setup.camera, room);
}

/// Of the plan before, the view that a light's map was in; null: there is none, or the map does not hold it.
const View* Planner::Impl::viewBefore(std::uint32_t light, const MapId& map) const
{
    if (!turns.lights[light].is_same) {
        return nullptr;
    }
    const std::span<const View> views = turns.viewsOf(light);
    const auto found = std::ranges::find_if(views, [&](const View& view) { return view.map == map; });
    return found != views.end() && store.holds(*found) ? &*found : nullptr;
}

/// Not of the first cascade, which is drawn in each frame.
bool Planner::Impl::hasOwnTurn(const Stand& stand, const Slice& slice) const
{
    return takes_turns && turns.lights[stand.light].by_cascade && std::isfinite(slice.depth.begin_m);
}

Outcome Planner::Impl::planWideSlice(const Frame& frame, const Stand& stand, Setup& setup, const PlannedSlice& slice)
{
    const Recipe& recipe = setup.recipe;
    const MapPlace& place = store.placeOf(slice.tenant, stand.slot, slice.frustum);
    const std::size_t map = place.map.index;
    if (turns.grounds.size() <= map) {
        turns.grounds.resize(map + 1);
        turns.next_grounds.resize(map + 1);
    }
    const ViewGround& ground = turns.grounds[map];
    const LightSpace space =
        lightSpaceOf(stand.at, slice.slice.axis_ws, slice.slice.half_angle_rad, setup.camera.scene_ws);
    const bool stood = viewBefore(stand.light, place.map) != nullptr && sameFrustum(ground.space, space);
    const Outcome seen = turns.seen.gatherReceivers({stood ? ground.space : space, slice.slice, setup.camera,
                                                     *frame.objects, slice.receivers, recipe.drawsReceivers()});
    if (seen.kind != OutcomeKind::ok) {
        return seen;
    }
    lookWide(frame, setup);
    if (setup.wide.camera.outcome.kind != OutcomeKind::ok) {
        return setup.wide.camera.outcome;
    }
    View planned;
    planned.light = stand.light;
    const Slice wide = widened(slice.slice, setup.camera, recipe.options.cascades.room);
    const Outcome outcome = frustums.plan({.frame = setup.wide.frame,
                                           .recipe = recipe,
                                           .camera = setup.wide.camera,
                                           .receivers = setup.wide.receivers,
                                           .levellers = recipe.steady() ? all_receivers : setup.wide.receivers,
                                           .light = stand.at,
                                           .slice = wide,
                                           .map_size = place.tile.width,
                                           .strength = slice.strength,
                                           .scene_ws = scene.box_ws(),
                                           .layers = setup.layers,
                                           .sight = recipe.warps() ? &setup.sight : nullptr,
                                           .ground = &turns.next_grounds[map]},
                                          planned, plan.casters);
    if (!outcome.hasMap()) {
        return outcome;
    }
    planned.slice = slice.slice.depth; // pixels choose by what is seen
    addView(stand, place, planned);
    view_maps.back().own_turn = true;
    view_maps.back().may_wait = stood && ground.covers(turns.seen, setup.camera.pad_m);
    return outcome;
}

/// Of each of a light's cascades its claim to be drawn. Near ones take more of the picture.
void Planner::Impl::claimByCascade(const Frame& frame, std::uint32_t index)
{
    const LightPlan& planned = plan.lights[index];
    const std::span<const SightPoint> points = setups[planned.options].sight.points();
    for (std::uint32_t i = planned.first_view; i < planned.first_view + planned.view_count; ++i) {
        const View& view = plan.views[i];
        const View* const before = viewBefore(index, view.map);
        const auto within = std::ranges::count_if(points, [&](const SightPoint& point) {
            return point.depth_m >= view.slice.begin_m && point.depth_m <= view.slice.end_m;
        });
        const double part =
            std::max(static_cast<double>(within) / std::max(static_cast<double>(points.size()), 1.0), kLeastPart);
        turns.claims.push_back({index, turns.lights[index].share * part, texelsDueOf(frame, i),
                                before != nullptr ? before->waited : 0, view_maps[i].may_wait, false, i});
    }
}

/// What the maps that are drawn were planned for.
void Planner::Impl::noteGrounds()
{
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        if (view_maps[i].own_turn) {
            const std::size_t map = plan.views[i].map.index;
            std::swap(turns.grounds[map], turns.next_grounds[map]);
        }
    }
}

/// How many texels of the maps of some options a frame may draw.
std::uint64_t Planner::Impl::drawBudget(const Frame& frame, const ShadowOptions& options)
{
    std::uint64_t texels = options.draw_budget_texels > 0 ? options.draw_budget_texels : kNoDrawBudget;
    const double rate = frame.draw_ms_per_texel;
    if (options.draw_budget_ms > 0.0 && std::isfinite(rate) && rate > 0.0) {
        const double affordable = std::floor(options.draw_budget_ms / rate);
        if (affordable < static_cast<double>(texels)) {
            texels = static_cast<std::uint64_t>(affordable);
        }
    }
    return texels;
}

} // namespace gnomon
