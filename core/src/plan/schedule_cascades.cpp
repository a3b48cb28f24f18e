// SPDX-License-Identifier: Apache-2.0
// Cascades of a light that take turns each by itself: planned with room around what is seen, and kept for as long as
// that still lies in what they were planned for.
#include "plan/schedule.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

bool Schedule::hasOwnTurn(const LightPosition& position, const Slice& slice) const
{
    return takes_turns_ && lights_[position.light].by_cascade && std::isfinite(slice.depth.begin_m);
}

WideTurn Schedule::wideTurn(const Sights& sights, const Places& places, const LightPosition& position,
                            const LightFrustum& frustum)
{
    const Setup& setup = sights.setups()[position.at.options];
    const Slice& slice = frustum.slice;
    const MapId map = places.store().placeOf(frustum.tenant, position.slot, frustum.number).map;
    if (grounds_.size() <= map.index) {
        grounds_.resize(map.index + 1);
        next_grounds_.resize(map.index + 1);
    }
    const ViewGround& ground = grounds_[map.index];
    const LightSpace space = lightSpaceOf(position.at, slice.axis_ws, slice.half_angle_rad, setup.camera.scene_ws);
    const bool stood = viewBefore(places.store(), position.light, map) != nullptr && sameFrustum(ground.space, space);
    WideTurn turn;
    turn.outcome = seen_.gatherReceivers({stood ? ground.space : space, slice, setup.camera, *sights.frame().objects,
                                          frustum.receivers, setup.recipe.drawsReceivers()});
    if (turn.outcome.kind == OutcomeKind::ok) {
        turn.seen = &lookWide(sights, position.at.options);
        turn.outcome = turn.seen->camera.outcome;
        turn.ground = &next_grounds_[map.index];
        turn.may_wait = stood && ground.covers(seen_, setup.camera.pad_m);
    }
    return turn;
}

WideSight& Schedule::lookWide(const Sights& sights, std::uint32_t options)
{
    WideSight& wide = wide_[options];
    if (!wide.looked) {
        wide.looked = true;
        const Setup& setup = sights.setups()[options];
        const double room = setup.recipe.options().cascades.room;
        wide.frame = sights.frame();
        wide.frame.camera = widened(wide.frame.camera, room);
        wide.camera.look(wide.frame, setup.recipe.options().max_distance_m * (1.0 + room), wide.receivers);
        wide.camera.near_m = setup.camera.near_m;
        wide.camera.far_m = widenedFar_m(setup.camera, room);
    }
    return wide;
}

/// The view that a light's map had in the plan before; null: there is none, or the map does not hold it.
const View* Schedule::viewBefore(const MapStore& store, std::uint32_t light, const MapId& map) const
{
    if (!lights_[light].is_same) {
        return nullptr;
    }
    const std::span<const View> views = viewsOf(light);
    const auto found = std::ranges::find_if(views, [&](const View& view) { return view.place.map == map; });
    return found != views.end() && store.holds(*found) ? &*found : nullptr;
}

/// Each of a light's cascades claims to be drawn. Near ones take more of the picture.
void Schedule::claimByCascade(const Results& results, std::uint32_t index)
{
    constexpr double kLeastPart = 0.01; // share of a slice in which none of the points in sight is
    const LightPlan& planned = results.plan.lights[index];
    const std::span<const SightPoint> points = results.sights.setups()[planned.options].sight.points();
    for (std::uint32_t i = planned.first_view; i < planned.first_view + planned.view_count; ++i) {
        const View& view = results.plan.views[i];
        const View* const before = viewBefore(results.store, index, view.place.map);
        const auto within = std::ranges::count_if(points, [&](const SightPoint& point) {
            return point.depth_m >= view.serves.slice.begin_m && point.depth_m <= view.serves.slice.end_m;
        });
        const double part =
            std::max(static_cast<double>(within) / std::max(static_cast<double>(points.size()), 1.0), kLeastPart);
        claims_.push_back({index, lights_[index].share * part, texelsDue(results, i),
                           before != nullptr ? before->contents.waited : 0, results.maps[i].may_wait, false, i});
    }
}

/// Remembers what the maps that are drawn were planned for.
void Schedule::noteGrounds(const Results& results)
{
    for (std::size_t i = 0; i < results.plan.views.size(); ++i) {
        if (results.maps[i].own_turn) {
            const std::size_t map = results.plan.views[i].place.map.index;
            std::swap(grounds_[map], next_grounds_[map]);
        }
    }
}

} // namespace gnomon
