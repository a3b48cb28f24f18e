// SPDX-License-Identifier: Apache-2.0
// Whose maps are drawn where a frame may not draw all that are out of date. Who waits keeps the views of the plan
// before. Of most lights that is decided when all is planned and what drawing takes is known. A light that `multi`
// would divide otherwise would lose its squares by that; so of those it is decided before, by the most that they may
// take.
#include "planner_impl.h"

#include <algorithm>

namespace gnomon {
namespace {

/// A view of the plan before as one of this plan, with nothing to draw.
View asDrawn(const View& before, std::uint32_t light)
{
    View view = before;
    view.light = light;
    view.presumes = view.makes;
    view.kept_presumes = view.kept_makes;
    view.redraw = false;
    view.redraw_kept = false;
    view.waited = before.waited + 1;
    view.dirty = {};
    return view;
}

} // namespace

void LightTurns::follow(std::span<const Light> frame)
{
    keys.clear();
    for (const Light& light : frame) {
        keys.push_back(light.key);
    }
    rows.follow(keys);
    known.resize(std::max<std::size_t>(known.size(), rows.end()));
    for (const std::uint32_t row : rows.gone()) {
        known[row] = {};
    }
    lights.assign(frame.size(), {});
}

/// Who waits of those that would be divided otherwise.
void Planner::Impl::foreseeTurns(const Frame& frame)
{
    if (!takes_turns) {
        return;
    }
    turns.follow(frame.lights);
    for (std::uint32_t options = 0; options < setups.size(); ++options) {
        if (setups[options].looked && setups[options].recipe.takesTurns()) {
            foreseeTurns(frame, options);
        }
    }
}

void Planner::Impl::foreseeTurns(const Frame& frame, std::uint32_t options)
{
    const Setup& setup = setups[options];
    findShares(frame, options);
    turns.claims.clear();
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        if (plan.lights[index].options != options || plan.lights[index].outcome.kind != OutcomeKind::ok) {
            continue;
        }
        LightTurn& turn = turns.lights[index];
        const KnownLight& known = turns.knownOf(index);
        turn.bounded = true;
        turn.share = light_shares.shareOf(index);
        turn.is_same = isAsBefore(frame, index);
        turn.by_cascade = turnsByCascade(frame.lights[index]);
        turn.keeps_views = !turn.by_cascade && canKeepViews(index);
        const bool differs = turn.keeps_views && setup.recipe.grows() && multi.differs(index);
        // What most lights had to be drawn for in the frame before, they have in this one.
        turn.texels = turn.keeps_views && !differs ? known.texels : texelsWanted(frame.lights[index], index);
        turn.kept_back = differs;
        turns.claims.push_back({index, turn.share, turn.texels, known.waited, turn.keeps_views, false});
    }
    turns.order.take(turns.claims, drawBudget(frame, setup.recipe.options), setup.recipe.options.longest_wait);
    for (const DrawTurn& claim : turns.claims) {
        LightTurn& turn = turns.lights[claim.light];
        if (!turn.kept_back) {
            continue;
        }
        turn.kept_back = !claim.drawn;
        turn.keeps_views = !claim.drawn;
        if (turn.kept_back) {
            const Light& light = frame.lights[claim.light];
            multi.restoreFrustums(
                {frame, setup.recipe, setup.camera, receiversOf(claim.light, light), setup.sight, light}, claim.light);
        }
    }
}

/// Could views of a light of the plan before stand for those of this one? Not where it had none, so that none is
/// without a shadow that it should have; nor where what they show is another thing than what is asked for now.
bool Planner::Impl::isAsBefore(const Frame& frame, std::uint32_t index) const
{
    const Light& light = frame.lights[index];
    const KnownLight& known = turns.knownOf(index);
    const Setup& setup = setups[light.options];
    const bool same = known.type == light.type && known.options == light.options && known.map_size == light.map_size;
    return !frame.cut && frame.objects->identity() == turns.objects && known.view_count > 0 && same &&
           !setup.recipe.converges() && !setup.recipe.steps(light) && setup.camera.outcome.kind == OutcomeKind::ok &&
           !setup.receivers.empty();
}

/// All of them, with what their maps hold?
bool Planner::Impl::canKeepViews(std::uint32_t index) const
{
    return turns.lights[index].is_same && std::ranges::all_of(turns.viewsOf(index), [&](const View& view) {
               return view.gpu_cascade == kNoIndex && store.holds(view);
           });
}

/// Of all the maps that a light wants.
std::uint64_t Planner::Impl::texelsWanted(const Light& light, std::uint32_t index) const
{
    const auto texelsOf = [](const MapWish& wish) {
        return std::uint64_t{wish.side} * wish.side * wish.count * wish.positions * (wish.keeps_still ? 2 : 1);
    };
    std::uint64_t texels = texelsOf(own_wishes[index]);
    for (const GrownFrustum& frustum : multi.frustumsOf(index)) {
        texels += texelsOf(wishOf(light, frustum));
    }
    return texels;
}

/// Maps that others need room of, or that have another size now, hold nothing that could be kept.
void Planner::Impl::keepRoomOfTurns()
{
    for (std::uint32_t index = 0; index < turns.lights.size(); ++index) {
        LightTurn& turn = turns.lights[index];
        turn.keeps_views = turn.keeps_views && std::ranges::all_of(turns.viewsOf(index), [&](const View& view) {
                               bool owns = false;
                               for (std::uint32_t i = first_tenants[index]; i < first_tenants[index + 1]; ++i) {
                                   owns = owns || store.owns(i, view.map);
                               }
                               return owns && store.holds(view);
                           });
        turn.kept_back = turn.kept_back && turn.keeps_views;
        turn.waits = turn.kept_back;
    }
}

bool Planner::Impl::isKeptBack(std::uint32_t index) const
{
    return takes_turns && turns.lights[index].kept_back;
}

/// Texels that have to be drawn for a light as it is planned.
std::uint64_t Planner::Impl::texelsDue(const Frame& frame, std::uint32_t index)
{
    const LightPlan& planned = plan.lights[index];
    std::uint64_t texels = 0;
    for (std::uint32_t i = planned.first_view; i < planned.first_view + planned.view_count; ++i) {
        texels += texelsDueOf(frame, i);
    }
    return texels;
}

std::uint64_t Planner::Impl::texelsDueOf(const Frame& frame, std::uint32_t index)
{
    const View& view = plan.views[index];
    if (view.gpu_cascade != kNoIndex) {
        return std::uint64_t{view.tile.width} * view.tile.height;
    }
    return store.wouldDraw(view, *view_maps[index].place,
                           std::span(plan.casters).subspan(view.first_caster, view.caster_count), *frame.objects);
}

void Planner::Impl::takeTurns(const Frame& frame)
{
    if (!takes_turns) {
        return;
    }
    for (std::uint32_t options = 0; options < setups.size(); ++options) {
        takeTurns(frame, options);
    }
    if (std::ranges::any_of(turns.lights, &LightTurn::waits) || std::ranges::any_of(view_maps, &ViewMap::waits)) {
        putViewsBack(frame);
    }
    noteGrounds();
    noteTurns(frame);
}

void Planner::Impl::takeTurns(const Frame& frame, std::uint32_t options)
{
    turns.claims.clear();
    for (std::uint32_t index = 0; index < turns.lights.size(); ++index) {
        LightTurn& turn = turns.lights[index];
        if (!turn.bounded || turn.waits || plan.lights[index].options != options) {
            continue;
        }
        if (turn.by_cascade) {
            claimByCascade(frame, index);
        } else {
            turn.texels = texelsDue(frame, index);
            turns.claims.push_back(
                {index, turn.share, turn.texels, turns.knownOf(index).waited, turn.keeps_views, false});
        }
    }
    const Recipe& recipe = setups[options].recipe;
    turns.order.take(turns.claims, drawBudget(frame, recipe.options), recipe.options.longest_wait);
    for (const DrawTurn& claim : turns.claims) {
        if (claim.view != kNoIndex) {
            view_maps[claim.view].waits = !claim.drawn;
            continue;
        }
        turns.lights[claim.light].waits = !claim.drawn;
        if (!claim.drawn && recipe.grows()) {
            multi.restoreMemory(claim.light);
        }
    }
}

/// Gives the lights and cascades that wait the views that they had.
void Planner::Impl::putViewsBack(const Frame& frame)
{
    turns.next_views.clear();
    turns.next_casters.clear();
    turns.next_maps.clear();
    const auto add = [&](View view, std::span<const std::uint32_t> from, const ViewMap& map) {
        const auto casters = from.subspan(view.first_caster, view.caster_count);
        view.first_caster = static_cast<std::uint32_t>(turns.next_casters.size());
        // Who is gone since cannot be drawn, should a backend have to draw the map all the same.
        std::uint32_t still = 0;
        for (std::uint32_t i = 0; i < casters.size(); ++i) {
            if (frame.objects->alive(casters[i])) {
                turns.next_casters.push_back(casters[i]);
                still += i < view.still_count ? 1 : 0;
            }
        }
        view.still_count = still;
        view.caster_count = static_cast<std::uint32_t>(turns.next_casters.size()) - view.first_caster;
        turns.next_views.push_back(view);
        turns.next_maps.push_back(map);
    };
    for (std::uint32_t index = 0; index < plan.lights.size(); ++index) {
        LightPlan& planned = plan.lights[index];
        const std::uint32_t first = planned.first_view;
        planned.first_view = static_cast<std::uint32_t>(turns.next_views.size());
        if (turns.lights[index].waits) {
            planned.outcome = turns.knownOf(index).outcome;
            planned.waited = turns.knownOf(index).waited + 1;
            for (const View& view : turns.viewsOf(index)) {
                add(asDrawn(view, index), turns.casters, {});
            }
        } else {
            for (std::uint32_t i = first; i < first + planned.view_count; ++i) {
                if (!view_maps[i].waits) {
                    add(plan.views[i], plan.casters, view_maps[i]);
                    continue;
                }
                View kept = asDrawn(*viewBefore(index, plan.views[i].map), index);
                kept.slice = plan.views[i].slice;
                planned.waited = std::max(planned.waited, kept.waited);
                add(kept, turns.casters, {});
            }
        }
        planned.view_count = static_cast<std::uint32_t>(turns.next_views.size()) - planned.first_view;
    }
    std::swap(plan.views, turns.next_views);
    std::swap(plan.casters, turns.next_casters);
    std::swap(view_maps, turns.next_maps);
}

void Planner::Impl::noteTurns(const Frame& frame)
{
    turns.objects = frame.objects->identity();
    for (std::uint32_t index = 0; index < turns.lights.size(); ++index) {
        const LightPlan& planned = plan.lights[index];
        const Light& light = frame.lights[index];
        KnownLight& known = turns.knownOf(index);
        known = {};
        if (turns.lights[index].bounded) {
            known = {light.type,
                     light.options,
                     light.map_size,
                     planned.first_view,
                     planned.view_count,
                     planned.waited,
                     turns.lights[index].texels,
                     planned.outcome};
        }
    }
}

} // namespace gnomon
