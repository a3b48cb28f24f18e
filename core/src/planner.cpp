// SPDX-License-Identifier: Apache-2.0
// A frame's way to its plan: what the camera sees, what each light wants, who has which maps; then one light after the
// other: where it stands, how it is divided, and for each slice a view and what of its map has to be drawn.
#include "auto/auto_choice.h"
#include "camera_view.h"
#include "frustum_planner.h"
#include "motion/sun_steps.h"
#include "recipe.h"
#include "soften/light_sample.h"
#include "soften/moved_boxes.h"
#include "store/map_store.h"

#include <gnomon/converge.h>
#include <gnomon/planner.h>
#include <gnomon/world_range.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace gnomon {
namespace {

/// One of a planner's options, and what the camera sees that they count for.
struct Setup {
    explicit Setup(const ShadowOptions& options) : recipe(options) {}

    Recipe recipe;
    bool looked = false; // in this frame
    CameraView camera;
    std::vector<std::uint32_t> receivers;
    Sight sight; // where the recipe predicts
};

/// One position that a light shines from.
struct Stand {
    std::uint32_t light = 0; // index into Frame::lights
    Light at;                // the light, shining from there
    SunPosition sun = SunPosition::only;
    std::uint32_t slot = 0; // which of its light's maps it has
    bool read = true;       // in this frame
};

/// Of what becomes of a light's slices, the highest is what is said of the light.
int rank(OutcomeKind kind)
{
    constexpr OutcomeKind kUpwards[] = {OutcomeKind::no_receiver, OutcomeKind::no_caster, OutcomeKind::degenerate,
                                        OutcomeKind::ok, OutcomeKind::fallback};
    return static_cast<int>(std::find(std::begin(kUpwards), std::end(kUpwards), kind) - std::begin(kUpwards));
}

Outcome noOptions(std::span<const ShadowOptions> options)
{
    return options.empty() ? Outcome{OutcomeKind::refused, "the planner was made of no options"} : Outcome{};
}

/// Can single precision tell what is in the frame apart?
Outcome checkRange(const ObjectSet& objects)
{
    const std::string_view fault = rangeFault(objects.bounds());
    return fault.empty() ? Outcome{} : Outcome{OutcomeKind::degenerate, fault};
}

} // namespace

struct Planner::Impl {
    /// Without any options it has the default ones, and `unusable` says why nobody plans by them.
    explicit Impl(std::span<const ShadowOptions> options, Outcome why_unusable = {});

    std::vector<Setup> setups; // at least one
    Outcome unusable;          // not ok: no light has a map, in any frame
    Outcome fault;             // not ok: no light has a map in this frame
    bool some_nowhere = false; // objects of this frame
    MapStore store;
    SunCourses suns;
    SunCourses suns_before; // as they were before this frame
    AutoChooser chooser;
    std::uint64_t frames = 0; // planned so far: whose turn it is
    bool spoilt = false;      // a plan ended half way, because something threw
    MovedBoxes moved;
    std::uint64_t converging = 0; // frames since the last cut: which sample is this frame's

    Plan plan;

    // Scratch.
    FrustumPlanner frustums;
    std::vector<Slice> slices;
    std::vector<std::uint32_t> keys; // of the frame's lights
    std::vector<MapWish> wishes;
    std::vector<std::uint32_t> all_receivers; // of the scene, where a steady map measures level depth
    std::vector<std::uint32_t> merged;

    void addPages(MapStore& to) const;
    void makePlan(const Frame& frame);
    void begin(const Frame& frame);
    void noteMovement(const Frame& frame);
    void look(const Frame& frame, Setup& setup);
    void listReceivers(const Frame& frame);
    void admit(const Frame& frame);
    MapWish decide(const Frame& frame, std::uint32_t index);
    void planLight(const Frame& frame, std::uint32_t index);
    Outcome prospect(std::uint32_t index, const Setup& setup) const;
    std::uint32_t followSun(const Frame& frame, const Recipe& recipe, const Light& light, SunSteps& steps);
    Outcome planStands(const Frame& frame, std::uint32_t index, std::uint32_t earlier_slot);
    void planStand(const Frame& frame, const Stand& stand, std::optional<Outcome>& best);
    const PartitionTraits& partitionOf(const Setup& setup, const Stand& stand);
    Outcome planSlice(const Frame& frame, const Stand& stand, const Setup& setup, std::uint32_t slice);
    void addView(const Frame& frame, const Stand& stand, std::uint32_t frustum, const View& planned);
};

Planner::Planner(const ShadowOptions& options) : Planner(std::span(&options, 1)) {}

Planner::Planner(std::span<const ShadowOptions> options) : impl_(std::make_unique<Impl>(options, noOptions(options))) {}

Planner::Impl::Impl(std::span<const ShadowOptions> options, Outcome why_unusable) : unusable(why_unusable)
{
    static const ShadowOptions defaults;
    auto resolved = std::make_shared<std::vector<ResolvedOptions>>();
    for (const ShadowOptions& one : options.empty() ? std::span(&defaults, 1) : options) {
        resolved->push_back(setups.emplace_back(one).recipe.resolved);
    }
    addPages(store);
    plan.options = std::move(resolved);
}

Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

void Planner::reset()
{
    if (impl_ != nullptr) {
        impl_->store.forget();
        impl_->chooser = {};
    }
}

void Planner::lost(const MapId& map)
{
    if (impl_ != nullptr) {
        impl_->store.lost(map);
    }
}

const ShadowOptions& Planner::options(std::uint32_t index) const
{
    static const ShadowOptions defaults;
    return impl_ != nullptr && index < impl_->setups.size() ? impl_->setups[index].recipe.asked : defaults;
}

const Plan& Planner::plan(const Frame& given)
{
    static const ObjectSet no_objects;
    if (impl_ == nullptr) {
        impl_ = std::make_unique<Impl>(std::span<const ShadowOptions>(),
                                       Outcome{OutcomeKind::refused, "the planner was moved from"});
    }
    Impl& s = *impl_;
    if (s.spoilt) { // nobody knows what the maps hold, nor whose they are
        MapStore fresh;
        s.addPages(fresh);
        s.store = std::move(fresh);
        std::swap(s.suns, s.suns_before);
        s.chooser = {};
        s.moved.forget();
        s.spoilt = false;
    }
    Frame frame = given;
    s.fault = s.unusable;
    if (frame.objects == nullptr) {
        s.fault = {OutcomeKind::degenerate, "the frame has no objects: Frame::objects is null"};
        frame.objects = &no_objects;
    }
    if (s.fault.kind == OutcomeKind::ok) {
        s.fault = checkRange(*frame.objects);
    }
    s.suns_before = s.suns;
    s.spoilt = true;
    s.makePlan(frame);
    s.spoilt = false;
    return s.plan;
}

void Planner::Impl::addPages(MapStore& to) const
{
    for (const Setup& setup : setups) {
        to.addPages(setup.recipe.resolved.largest_side(), setup.recipe.options.max_layers);
    }
}

void Planner::Impl::makePlan(const Frame& frame)
{
    some_nowhere = frame.objects->nowhere() > 0;
    begin(frame);
    noteMovement(frame);
    admit(frame);
    listReceivers(frame);
    store.beginFrame(*frame.objects, keys, wishes);
    suns.begin();
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
        planLight(frame, light);
    }
    suns.end();
    store.report(plan);
    ++frames;
    ++converging;
}

void Planner::Impl::begin(const Frame& frame)
{
    plan.frame = frame.index;
    plan.mask_layers = (static_cast<std::uint32_t>(frame.lights.size()) + 3) / 4;
    plan.lights.clear();
    plan.views.clear();
    plan.casters.clear();
    for (Setup& setup : setups) {
        setup.looked = false;
    }
}

/// Which plan this is, and what of the pictures before it still holds.
void Planner::Impl::noteMovement(const Frame& frame)
{
    plan.cut = frame.cut || frames == 0;
    plan.number = frames + 1;
    plan.moved_ws.clear();
    if (std::ranges::any_of(setups, [](const Setup& setup) { return setup.recipe.converges(); })) {
        plan.cut = !moved.follow(*frame.objects, plan.moved_ws) || plan.cut;
    }
    converging = plan.cut ? 0 : converging;
}

// ---- All lights: what each wants, and what the camera sees for it

void Planner::Impl::admit(const Frame& frame)
{
    keys.clear();
    wishes.clear();
    look(frame, setups[0]);
    chooser.follow(frame.lights);
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        const Light& light = frame.lights[index];
        LightPlan& planned = plan.lights.emplace_back();
        planned.mask_layer = index / 4;
        planned.mask_channel = index % 4;
        keys.push_back(light.key);
        wishes.emplace_back();
        if (fault.kind != OutcomeKind::ok) {
            planned.outcome = fault;
            continue;
        }
        if (light.options >= setups.size()) {
            planned.outcome = {OutcomeKind::refused, "Light::options names none of the planner's options"};
            continue;
        }
        planned.options = light.options;
        Setup& setup = setups[light.options];
        planned.outcome = setup.recipe.check(light);
        if (planned.outcome.kind != OutcomeKind::ok) {
            continue;
        }
        look(frame, setup);
        wishes.back() = decide(frame, index);
    }
}

/// The maps of a light, by its options or by what is predicted of it.
MapWish Planner::Impl::decide(const Frame& frame, std::uint32_t index)
{
    const Light& light = frame.lights[index];
    const Setup& setup = setups[light.options];
    const Recipe& recipe = setup.recipe;
    if (!recipe.predicts()) {
        return recipe.wishOf(light, light.options, *recipe.partition, 0);
    }
    if (setup.camera.outcome.kind == OutcomeKind::ok && !setup.receivers.empty()) {
        const Slice none;
        plan.lights[index].choice =
            chooser
                .decide({frame, recipe, setup.camera, setup.receivers, setup.receivers, light, none}, setup.sight,
                        index, frustums)
                .told;
    }
    const AutoDecision& decision = chooser.decisionOf(recipe, index);
    return recipe.wishOf(light, light.options, *decision.partition, decision.told.halvings);
}

void Planner::Impl::look(const Frame& frame, Setup& setup)
{
    if (setup.looked) {
        return;
    }
    setup.looked = true;
    CameraView& camera = setup.camera;
    const ShadowOptions& options = setup.recipe.options;
    camera.look(frame, options.max_distance_m, setup.receivers);
    if (camera.outcome.kind != OutcomeKind::ok || setup.receivers.empty()) {
        return;
    }
    if (setup.recipe.predicts()) {
        setup.sight.look(frame, camera, setup.receivers);
    }
    if (setup.recipe.steady()) {
        camera.boundDepths(frame.camera, options.max_distance_m);
    } else if (setup.recipe.partition != nullptr && setup.recipe.partition->measures) {
        camera.measureDepths(*frame.objects, setup.receivers);
    } else {
        return;
    }
    if (!std::isfinite(camera.far_m - camera.near_m)) {
        camera.outcome = {OutcomeKind::degenerate, "the camera's numbers leave no depths to divide"};
    }
}

/// What the camera sees by any of the options that count in this frame.
void Planner::Impl::listReceivers(const Frame& frame)
{
    plan.receivers.clear();
    all_receivers.clear();
    bool levels = false;
    for (const Setup& setup : setups) {
        if (!setup.looked) {
            continue;
        }
        levels = levels || (setup.recipe.steady() && setup.recipe.levelsDepth());
        if (plan.receivers.empty()) {
            plan.receivers.assign(setup.receivers.begin(), setup.receivers.end());
            continue;
        }
        merged.clear();
        std::ranges::set_union(plan.receivers, setup.receivers, std::back_inserter(merged));
        std::swap(plan.receivers, merged);
    }
    if (levels) {
        frame.objects->query({}, ObjectSet::Want::receivers, all_receivers);
    }
}

// ---- One light

void Planner::Impl::planLight(const Frame& frame, std::uint32_t index)
{
    const Light& light = frame.lights[index];
    LightPlan& planned = plan.lights[index];
    const Setup& setup = setups[planned.options];
    planned.first_view = static_cast<std::uint32_t>(plan.views.size());
    const std::uint32_t earlier_slot = followSun(frame, setup.recipe, light, planned.steps);
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = prospect(index, setup);
    }
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = planStands(frame, index, earlier_slot);
    }
    planned.view_count = static_cast<std::uint32_t>(plan.views.size()) - planned.first_view;
}

/// Can a light that may have maps have any in this frame?
Outcome Planner::Impl::prospect(std::uint32_t index, const Setup& setup) const
{
    if (!store.hasRoom(index)) {
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
    return {};
}

/// Where a sun stands for its maps; returns the slot of its earlier position.
std::uint32_t Planner::Impl::followSun(const Frame& frame, const Recipe& recipe, const Light& light, SunSteps& steps)
{
    if (!recipe.steps(light) || checkLight(light).kind != OutcomeKind::ok) {
        return 0;
    }
    const SunCourse& course = suns.follow(light, frame.time_s, recipe.motion->stepping, recipe.options.steps);
    steps = course.steps();
    // By turns of the slots, not of the positions: then after a step too the frame before has read the other one, or
    // the one whose weight was next to nothing.
    steps.read = (frames & 1) == course.earlierSlot() ? SunPosition::earlier : SunPosition::later;
    return course.earlierSlot();
}

/// A position keeps its slot, that is its maps, for as long as the sun has it.
Outcome Planner::Impl::planStands(const Frame& frame, std::uint32_t index, std::uint32_t earlier_slot)
{
    const SunSteps steps = plan.lights[index].steps;
    const Recipe& recipe = setups[plan.lights[index].options].recipe;
    const bool has_slots = recipe.pairs(frame.lights[index]);
    if (recipe.converges()) {
        plan.lights[index].sample =
            sampleOf(frame.lights[index], convergeSample(recipe.filter->integrates_light ? 0 : converging));
        plan.lights[index].sample.number = static_cast<std::uint32_t>(converging % 1024);
    }
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
        if (const LightSample& sample = plan.lights[index].sample; sample.joined) {
            stand.at.position_ws = sample.position_ws;
            stand.at.direction_ws = sample.direction_ws;
        }
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
    const Setup& setup = setups[stand.at.options];
    slices.clear();
    partitionOf(setup, stand).divide({stand.at, setup.camera, setup.recipe.options.cascades}, slices);
    for (std::uint32_t i = 0; i < slices.size(); ++i) {
        const Outcome outcome = planSlice(frame, stand, setup, i);
        if (!best || rank(outcome.kind) > rank(best->kind)) {
            best = outcome;
        }
    }
}

const PartitionTraits& Planner::Impl::partitionOf(const Setup& setup, const Stand& stand)
{
    return setup.recipe.predicts() ? *chooser.decisionOf(setup.recipe, stand.light).partition : *setup.recipe.partition;
}

Outcome Planner::Impl::planSlice(const Frame& frame, const Stand& stand, const Setup& setup, std::uint32_t slice)
{
    const Recipe& recipe = setup.recipe;
    View planned;
    planned.light = stand.light;
    planned.sun = stand.sun;
    const glm::dvec2 grid_move = recipe.converges() ? convergeSample(converging).grid_texels : glm::dvec2(0.0);
    const bool on_gpu = partitionOf(setup, stand).fits_on_gpu; // whose views have a grid of their own
    planned.grid_move_texels = on_gpu ? grid_move : glm::dvec2(0.0);
    const Outcome outcome =
        frustums.plan({frame, recipe, setup.camera, setup.receivers, recipe.steady() ? all_receivers : setup.receivers,
                       stand.at, slices[slice], store.placeOf(stand.light, stand.slot, slice).tile.width,
                       recipe.predicts() ? chooser.decisionOf(recipe, stand.light).strengths[slice] : 1.0,
                       on_gpu ? glm::dvec2(0.0) : grid_move},
                      planned, plan.casters);
    if (!outcome.hasMap()) {
        return outcome;
    }
    if (!on_gpu) {
        addView(frame, stand, slice, planned);
        return outcome;
    }
    // A base map: one view for each cascade that the GPU will fit to a part of it.
    for (planned.gpu_cascade = 0; planned.gpu_cascade < recipe.mapsOf(partitionOf(setup, stand));
         ++planned.gpu_cascade) {
        addView(frame, stand, planned.gpu_cascade, planned);
    }
    return outcome;
}

/// Says where a view's map is, and what of it has to be drawn.
void Planner::Impl::addView(const Frame& frame, const Stand& stand, std::uint32_t frustum, const View& planned)
{
    View& view = plan.views.emplace_back(planned);
    const MapPlace& place = store.placeOf(stand.light, stand.slot, frustum);
    view.map = place.map;
    view.tile = place.tile;
    view.part = place.part;
    if (view.gpu_cascade != kNoIndex) {
        store.drawAnew(view);
    } else if (stand.read) {
        store.draw(view, place, std::span(plan.casters).subspan(view.first_caster, view.caster_count), *frame.objects);
    } else {
        view.redraw = false;
    }
}

} // namespace gnomon
