// SPDX-License-Identifier: Apache-2.0
// One light of a frame: where it stands, how it is divided, and for each slice a view and what of its map has to be
// drawn.
#include "light_reach.h"
#include "planner_impl.h"
#include "soften/light_sample.h"

#include <gnomon/converge.h>
#include <gnomon/object_ids.h>

#include <algorithm>
#include <bit>
#include <iterator>

namespace gnomon {
namespace {

/// Of what becomes of a light's slices, the highest is what is said of the light.
int rank(OutcomeKind kind)
{
    constexpr OutcomeKind kUpwards[] = {OutcomeKind::no_receiver, OutcomeKind::no_caster, OutcomeKind::degenerate,
                                        OutcomeKind::ok, OutcomeKind::fallback};
    return static_cast<int>(std::find(std::begin(kUpwards), std::end(kUpwards), kind) - std::begin(kUpwards));
}

} // namespace

void Planner::Impl::planLight(const Frame& frame, std::uint32_t index)
{
    const Light& light = frame.lights[index];
    LightPlan& planned = plan.lights[index];
    const Setup& setup = setups[planned.options];
    planned.first_view = static_cast<std::uint32_t>(plan.views.size());
    if (!setup.recipe.hasMaps()) {
        planVolumes(frame, index);
        return;
    }
    if (isKeptBack(index)) {
        return; // its views are those of the plan before
    }
    const std::uint32_t earlier_slot = followSun(frame, setup.recipe, light, planned.steps);
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = prospect(frame, index, setup);
    }
    if (planned.outcome.kind == OutcomeKind::ok && setup.recipe.filter->ids) {
        planned.outcome = handOut(frame, index);
    }
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = planStands(frame, index, earlier_slot);
    }
    planned.view_count = static_cast<std::uint32_t>(plan.views.size()) - planned.first_view;
}

/// Ids for the objects of a light that tells them apart. Of a sun that moves in steps in the order from where it
/// stands, so that they last as its maps do.
Outcome Planner::Impl::handOut(const Frame& frame, std::uint32_t index)
{
    LightPlan& planned = plan.lights[index];
    const ResolvedOptions& options = setups[planned.options].recipe.resolved;
    const ObjectSet& objects = *frame.objects;
    if (objects.size() > kMostIdObjects) {
        static_assert(kMostIdObjects == 1048575);
        return {OutcomeKind::refused, "ids tell at most 1048575 objects apart"};
    }
    if (options.ids().of == IdOf::face && plan.object_pieces.empty()) {
        plan.object_pieces.resize(objects.size(), 0);
        for (std::uint32_t object = 0; object < objects.size(); ++object) {
            plan.object_pieces[object] = objects.flags(object).pieces;
            if (objects.flags(object).casts && plan.object_pieces[object] == 0) {
                plan.object_pieces.clear();
                return {OutcomeKind::refused,
                        "id.of face: an object that casts does not say of how many pieces it is (ObjectFlags::pieces)"};
            }
        }
    }
    Light light = frame.lights[index];
    if (planned.steps.stepping) {
        light.direction_ws = planned.steps.earlier_ws;
    }
    if (plan.object_bounds.empty()) {
        shareIdBounds(objects, id_scratch, plan.object_bounds);
        shares_bounds.assign(plan.object_bounds.size(), false);
        for (const auto& [a, b] : id_scratch.links) {
            shares_bounds[a] = shares_bounds[a] || a != b;
            shares_bounds[b] = shares_bounds[b] || a != b;
        }
    }
    planned.first_object_id = static_cast<std::uint32_t>(plan.object_ids.size());
    handOutIds(light, objects,
               {.most = idsOf(options.format()),
                .of = options.ids().of,
                .sharing = idSharingOf(options.filter(), options.ids().of)},
               id_scratch, plan.object_ids);
    return {};
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991) over the ids of a view's casters, and over bounds that are not their
/// own alone: other ids, another key.
std::uint64_t Planner::Impl::idsKey(const View& view) const
{
    const std::span<const std::uint16_t> ids = objectIdsOf(plan, view.light);
    if (ids.empty()) {
        return 0;
    }
    std::uint64_t key = 14695981039346656037ULL;
    for (std::uint32_t i = 0; i < view.caster_count; ++i) {
        const std::uint32_t object = plan.casters[view.first_caster + i];
        const auto add = [&](std::uint32_t number) {
            key = (key ^ number) * 1099511628211ULL;
        };
        add(ids[object]);
        const Aabb& box = plan.object_bounds[object];
        if (shares_bounds[object]) {
            for (int axis = 0; axis < 3; ++axis) {
                add(std::bit_cast<std::uint32_t>(box.min[axis]));
                add(std::bit_cast<std::uint32_t>(box.max[axis]));
            }
        }
    }
    return std::max<std::uint64_t>(key, 1);
}

/// All of what a light wants has room, or nothing is drawn of it.
bool Planner::Impl::hasRoom(std::uint32_t index, const Setup& setup) const
{
    for (std::uint32_t tenant = first_tenants[index]; tenant < first_tenants[index + 1]; ++tenant) {
        if (!store.hasRoom(tenant)) {
            return false;
        }
    }
    return setup.recipe.grows() || first_tenants[index] < first_tenants[index + 1];
}

/// Can a light that may have maps have any in this frame?
Outcome Planner::Impl::prospect(const Frame& frame, std::uint32_t index, const Setup& setup) const
{
    if (setup.recipe.hasMaps() && !hasRoom(index, setup)) {
        return {OutcomeKind::atlas_full, "the atlas has no layer left for this light"};
    }
    if (setup.camera.outcome.kind != OutcomeKind::ok) {
        return setup.camera.outcome;
    }
    if (setup.receivers.empty()) {
        return {
            OutcomeKind::no_receiver,
            some_nowhere
                ? "the camera sees nothing that receives shadow, and some objects are nowhere (ObjectSet::nowhere())"
                : "the camera sees nothing that receives shadow"};
    }
    if (setup.recipe.options.technique.filter == Filter::pcss) {
        const Outcome width = widthForPcss(frame.lights[index], *frame.objects);
        if (width.kind != OutcomeKind::ok) {
            return width;
        }
    }
    return {};
}

/// Where a sun stands for its maps; returns the slot of its earlier position.
std::uint32_t Planner::Impl::followSun(const Frame& frame, const Recipe& recipe, const Light& light, SunSteps& steps)
{
    if (!recipe.steps(light) || checkLight(light).kind != OutcomeKind::ok) {
        return 0;
    }
    const SunCourse& course =
        suns.follow(light, frame.time_s, recipe.motion->stepping, recipe.options.steps, camera_moves);
    steps = course.steps();
    // By turns of the slots, not of the positions: then after a step too the frame before has read the other one, or
    // the one whose weight was next to nothing.
    steps.read = (frames & 1) == course.earlierSlot() ? SunPosition::earlier : SunPosition::later;
    return course.earlierSlot();
}

/// Which point of a light whose mask is a mean over frames this frame sees it from.
LightSample Planner::Impl::sampleAt(const Frame& frame, std::uint32_t index) const
{
    const Recipe& recipe = setups[plan.lights[index].options].recipe;
    LightSample sample;
    if (recipe.converges()) {
        sample = sampleOf(frame.lights[index], convergeSample(recipe.resolved.integratesLight() ? 0 : converging));
        sample.number = static_cast<std::uint32_t>(converging % 1024);
    }
    return sample;
}

/// A position keeps its slot, that is its maps, for as long as the sun has it.
Outcome Planner::Impl::planStands(const Frame& frame, std::uint32_t index, std::uint32_t earlier_slot)
{
    const SunSteps steps = plan.lights[index].steps;
    const Recipe& recipe = setups[plan.lights[index].options].recipe;
    const bool has_slots = recipe.pairs(frame.lights[index]);
    plan.lights[index].sample = sampleAt(frame, index);
    std::optional<Outcome> best;
    for (const bool later : {false, true}) {
        if (later && !steps.paired) {
            break;
        }
        Stand stand;
        stand.light = index;
        stand.at = frame.lights[index];
        if (steps.stepping) {
            stand.at.direction_ws = later ? steps.later_ws : steps.earlier_ws;
        }
        stand.at = sampledLight(stand.at, plan.lights[index].sample);
        if (steps.paired) {
            stand.sun = later ? SunPosition::later : SunPosition::earlier;
        }
        stand.read = !steps.alternate || stand.sun == steps.read;
        if (has_slots) {
            stand.slot = later ? 1 - earlier_slot : earlier_slot;
        }
        planStand(frame, stand, best);
    }
    return *best;
}

/// A slice without receivers or casters needs no map; the light has one when any slice does.
void Planner::Impl::planStand(const Frame& frame, const Stand& stand, std::optional<Outcome>& best)
{
    Setup& setup = setups[stand.at.options];
    listSlices(frame, stand, setup);
    if (planned_slices.empty() && !best) {
        best = {OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
    }
    for (const PlannedSlice& slice : planned_slices) {
        const Outcome outcome = planSlice(frame, stand, setup, slice);
        if (!best || rank(outcome.kind) > rank(best->kind)) {
            best = outcome;
        }
    }
}

/// How the light is divided.
void Planner::Impl::listSlices(const Frame& frame, const Stand& stand, const Setup& setup)
{
    const std::uint32_t tenant = first_tenants[stand.light];
    planned_slices.clear();
    if (setup.recipe.grows()) {
        for (const GrownFrustum& one : multi.frustumsOf(stand.light)) {
            const auto number = static_cast<std::uint32_t>(planned_slices.size());
            PlannedSlice& planned = planned_slices.emplace_back(
                PlannedSlice{one.slice, multi.receiversOf(one), one.strength, tenant + number, 0});
            // Where room is scarce its map is smaller than it asked for.
            planned.slice.texel *= static_cast<double>(one.side) / store.sideOf(tenant + number);
        }
        return;
    }
    slices.clear();
    const Recipe& recipe = setup.recipe;
    partitionOf(setup, stand).divide({stand.at, setup.camera, recipe.options.cascades}, slices);
    if (const std::uint32_t segments = recipe.resolved.segments(); segments > 1) {
        const Slice whole = slices.front();
        const std::span receivers = receiversOf(stand.light, stand.at);
        slices.clear();
        frustums.divideTsm({frame, recipe, setup.camera, receivers, receivers, stand.at, whole,
                            store.placeOf(tenant, stand.slot, 0).tile.width},
                           segments, recipe.options.cascades.blend, slices);
    }
    for (std::uint32_t i = 0; i < slices.size(); ++i) {
        const double strength = recipe.searchesWarp() ? chooser.decisionOf(recipe, stand.light).strengths[i] : 1.0;
        planned_slices.push_back({slices[i], receiversOf(stand.light, stand.at), strength, tenant, i});
    }
}

const PartitionTraits& Planner::Impl::partitionOf(const Setup& setup, const Stand& stand)
{
    // A recipe with maps that predicts nothing has one. NOLINTNEXTLINE(clang-analyzer-core.uninitialized.UndefReturn)
    return setup.recipe.predicts() ? *chooser.decisionOf(setup.recipe, stand.light).partition : *setup.recipe.partition;
}

Outcome Planner::Impl::planSlice(const Frame& frame, const Stand& stand, Setup& setup, const PlannedSlice& slice)
{
    if (hasOwnTurn(stand, slice.slice)) {
        return planWideSlice(frame, stand, setup, slice);
    }
    const Recipe& recipe = setup.recipe;
    View planned;
    planned.light = stand.light;
    planned.sun = stand.sun;
    const glm::dvec2 grid_move = recipe.converges() ? convergeSample(converging).grid_texels : glm::dvec2(0.0);
    const bool on_gpu = partitionOf(setup, stand).fits_on_gpu; // whose views have a grid of their own
    planned.grid_move_texels = on_gpu ? grid_move : glm::dvec2(0.0);
    const MapPlace& place = store.placeOf(slice.tenant, stand.slot, slice.frustum);
    const Outcome outcome =
        frustums.plan({frame, recipe, setup.camera, slice.receivers, recipe.steady() ? all_receivers : slice.receivers,
                       stand.at, slice.slice, place.tile.width, slice.strength, on_gpu ? glm::dvec2(0.0) : grid_move,
                       scene.box_ws(), setup.layers, recipe.warps() ? &setup.sight : nullptr},
                      planned, plan.casters);
    if (!outcome.hasMap()) {
        return outcome;
    }
    if (!on_gpu) {
        addView(stand, place, planned);
        return outcome;
    }
    // A base map: one view for each cascade that the GPU will fit to a part of it.
    for (planned.gpu_cascade = 0; planned.gpu_cascade < recipe.mapsOf(partitionOf(setup, stand));
         ++planned.gpu_cascade) {
        addView(stand, store.placeOf(slice.tenant, stand.slot, planned.gpu_cascade), planned);
    }
    return outcome;
}

/// Says where a view's map is. What of it has to be drawn is said when all views are known.
void Planner::Impl::addView(const Stand& stand, const MapPlace& place, const View& planned)
{
    View& view = plan.views.emplace_back(planned);
    view.map = place.map;
    view.tile = place.tile;
    view.part = place.part;
    view.ids_key = idsKey(view);
    view_maps.push_back({&place, stand.read});
}

void Planner::Impl::drawViews(const Frame& frame)
{
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        View& view = plan.views[i];
        if (view_maps[i].place == nullptr) {
            continue; // of a light that waits
        }
        if (view.gpu_cascade != kNoIndex) {
            store.drawAnew(view);
        } else if (view_maps[i].read) {
            store.draw(view, *view_maps[i].place, std::span(plan.casters).subspan(view.first_caster, view.caster_count),
                       *frame.objects);
        } else {
            view.redraw = false;
        }
    }
}

} // namespace gnomon
