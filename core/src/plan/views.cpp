// SPDX-License-Identifier: Apache-2.0
#include "plan/views.h"

#include "light_reach.h"
#include "plan/schedule.h"

#include <gnomon/converge.h>

#include <algorithm>
#include <iterator>

namespace gnomon {
namespace {

/// A light's outcome is that of the frustum that ranks highest.
int rank(OutcomeKind kind)
{
    constexpr OutcomeKind kUpwards[] = {OutcomeKind::no_receiver, OutcomeKind::no_caster, OutcomeKind::degenerate,
                                        OutcomeKind::ok, OutcomeKind::fallback};
    return static_cast<int>(std::find(std::begin(kUpwards), std::end(kUpwards), kind) - std::begin(kUpwards));
}

} // namespace

void Views::fit(const Sights& sights, const Frustums& frustums, const Places& places, Schedule& schedule, Plan& plan)
{
    plan.views.clear();
    plan.casters.clear();
    plan.object_ids.clear();
    plan.object_bounds.clear();
    plan.object_pieces.clear();
    maps_.clear();
    const Results from{sights, frustums, places, schedule, plan};
    for (std::uint32_t light = 0; light < plan.lights.size(); ++light) {
        fitLight(from, light);
    }
}

void Views::fitLight(const Results& from, std::uint32_t index)
{
    LightPlan& planned = from.plan.lights[index];
    const Recipe& recipe = from.setupOf(index).recipe;
    planned.first_view = static_cast<std::uint32_t>(from.plan.views.size());
    if (!recipe.hasMaps()) {
        listVolumes(from, index);
        return;
    }
    if (from.schedule.isKeptBack(index)) {
        return; // its views are those of the plan before
    }
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = prospect(from, index);
    }
    if (planned.outcome.kind == OutcomeKind::ok && recipe.resolved.traits().ids) {
        planned.outcome = handOutIds(from, index);
    }
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = fitPositions(from, index);
    }
    planned.view_count = static_cast<std::uint32_t>(from.plan.views.size()) - planned.first_view;
}

/// Can a light that may have maps have any in this frame?
Outcome Views::prospect(const Results& from, std::uint32_t index)
{
    const Setup& setup = from.setupOf(index);
    if (setup.recipe.hasMaps() && !from.places.hasRoom(from.frustums, index, setup.recipe)) {
        return {OutcomeKind::atlas_full, "the atlas has no layer left for this light"};
    }
    if (setup.camera.outcome.kind != OutcomeKind::ok) {
        return setup.camera.outcome;
    }
    const ObjectSet& objects = *from.sights.frame().objects;
    if (setup.receivers.empty()) {
        return {
            OutcomeKind::no_receiver,
            objects.nowhere() > 0
                ? "the camera sees nothing that receives shadow, and some objects are nowhere (ObjectSet::nowhere())"
                : "the camera sees nothing that receives shadow"};
    }
    if (setup.recipe.options().technique.filter == Filter::pcss) {
        const Outcome width = widthForPcss(from.sights.frame().lights[index], objects);
        if (width.kind != OutcomeKind::ok) {
            return width;
        }
    }
    return {};
}

/// A frustum without receivers or casters needs no map; the light has one when any frustum does.
Outcome Views::fitPositions(const Results& from, std::uint32_t index)
{
    from.plan.lights[index].sample = from.sights.lights()[index].sample;
    std::optional<Outcome> best;
    for (const LightPosition& position : from.frustums.positionsOf(index)) {
        if (position.frustum_count == 0 && from.frustums.outcomeOf(index).kind != OutcomeKind::ok) {
            best = from.frustums.outcomeOf(index);
        }
        if (position.frustum_count == 0 && !best) {
            best = {OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
        }
        for (const LightFrustum& frustum : from.frustums.of(position)) {
            if (frustum.page != nullptr) {
                best = placePage(from, position, frustum);
                continue;
            }
            const Outcome outcome = from.schedule.hasOwnTurn(position, frustum.slice)
                                        ? fitWide(from, position, frustum)
                                        : fitFrustum(from, position, frustum);
            if (!best || rank(outcome.kind) > rank(best->kind)) {
                best = outcome;
            }
        }
    }
    return *best;
}

Outcome Views::fitFrustum(const Results& from, const LightPosition& position, const LightFrustum& frustum)
{
    const Setup& setup = from.setupOf(position.light);
    const Recipe& recipe = setup.recipe;
    const bool on_gpu = frustum.gpu_cascades > 0; // whose views have a grid of their own
    const glm::dvec2 grid_move =
        recipe.converges() ? convergeSample(from.sights.converging()).grid_texels : glm::dvec2(0.0);
    const MapStore& store = from.places.store();
    const MapPlace& place = store.placeOf(frustum.tenant, position.slot, frustum.number);
    Slice slice = frustum.slice;
    if (frustum.wanted_side > 0) { // where room is scarce its map is smaller than it asked for
        slice.texel *= static_cast<double>(frustum.wanted_side) / store.sideOf(frustum.tenant);
    }
    View fitted;
    fitted.light = position.light;
    fitted.serves.sun = position.sun;
    fitted.projection.grid_move_texels = on_gpu ? grid_move : glm::dvec2(0.0);
    const Outcome outcome =
        planner_.plan({from.sights.frame(), recipe, setup.camera, frustum.receivers,
                       recipe.steady() ? from.sights.allReceivers() : frustum.receivers, position.at, slice,
                       place.tile.width, frustum.strength, on_gpu ? glm::dvec2(0.0) : grid_move, from.sights.scene_ws(),
                       setup.layers, recipe.warps() ? &setup.sight : nullptr},
                      fitted, from.plan.casters);
    if (!outcome.hasMap()) {
        return outcome;
    }
    if (!on_gpu) {
        addView(from, position, place, fitted);
        return outcome;
    }
    // A base map: one view for each cascade that the GPU will fit to a part of it.
    for (fitted.projection.gpu_cascade = 0; fitted.projection.gpu_cascade < frustum.gpu_cascades;
         ++fitted.projection.gpu_cascade) {
        addView(from, position, store.placeOf(frustum.tenant, position.slot, fitted.projection.gpu_cascade), fitted);
    }
    return outcome;
}

/// With room around what is seen, so that the map may wait while the camera moves.
Outcome Views::fitWide(const Results& from, const LightPosition& position, const LightFrustum& frustum)
{
    const Setup& setup = from.setupOf(position.light);
    const Recipe& recipe = setup.recipe;
    const MapPlace& place = from.places.store().placeOf(frustum.tenant, position.slot, frustum.number);
    const WideTurn turn = from.schedule.wideTurn(from.sights, from.places, position, frustum);
    if (turn.outcome.kind != OutcomeKind::ok) {
        return turn.outcome;
    }
    const std::span<const std::uint32_t> levellers =
        recipe.steady() ? from.sights.allReceivers() : std::span<const std::uint32_t>(turn.seen->receivers);
    const Slice wide = widened(frustum.slice, setup.camera, recipe.options().cascades.room);
    View fitted;
    fitted.light = position.light;
    const Outcome outcome = planner_.plan({.frame = turn.seen->frame,
                                           .recipe = recipe,
                                           .camera = turn.seen->camera,
                                           .receivers = turn.seen->receivers,
                                           .levellers = levellers,
                                           .light = position.at,
                                           .slice = wide,
                                           .map_size = place.tile.width,
                                           .strength = frustum.strength,
                                           .scene_ws = from.sights.scene_ws(),
                                           .layers = setup.layers,
                                           .sight = recipe.warps() ? &setup.sight : nullptr,
                                           .ground = turn.ground},
                                          fitted, from.plan.casters);
    if (!outcome.hasMap()) {
        return outcome;
    }
    fitted.serves.slice = frustum.slice.depth; // pixels choose by what is seen
    addView(from, position, place, fitted);
    maps_.back().own_turn = true;
    maps_.back().may_wait = turn.may_wait;
    return outcome;
}

/// A page's projection is the grid's, whatever is seen.
Outcome Views::placePage(const Results& from, const LightPosition& position, const LightFrustum& frustum)
{
    const VirtualPartition& pages = from.frustums.pages();
    const MapPlace& place = from.places.store().placeOf(frustum.tenant, position.slot, frustum.number);
    View view;
    view.light = position.light;
    view.serves.sun = position.sun;
    pages.project(position.light, *frustum.page, place.tile.width, view);
    if (!isFinite(view)) {
        return kTooFarApart;
    }
    const std::span casters = pages.castersOf(*frustum.page);
    view.casters.first = static_cast<std::uint32_t>(from.plan.casters.size());
    view.casters.count = static_cast<std::uint32_t>(casters.size());
    from.plan.casters.insert(from.plan.casters.end(), casters.begin(), casters.end());
    addView(from, position, place, view);
    return {};
}

/// Says where a view's map is. Schedule says later what of it has to be drawn.
void Views::addView(const Results& from, const LightPosition& position, const MapPlace& place, const View& fitted)
{
    View& view = from.plan.views.emplace_back(fitted);
    view.place.map = place.map;
    view.place.tile = place.tile;
    view.place.part = place.part;
    view.contents.ids_key = idsKey(from.plan, view);
    maps_.push_back({&place, position.read});
}

} // namespace gnomon
