// SPDX-License-Identifier: Apache-2.0
// A frame's way to its plan: what the camera sees, what each light wants, who has which maps; then one light after the
// other (planner_light.cpp).
#include "light_reach.h"
#include "planner_impl.h"
#include "soften/light_sample.h"

#include <gnomon/world_range.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace gnomon {
namespace {

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

/// Four lights share a layer of the mask, but a coloured one has its own. Where none is coloured light i has channel
/// i % 4 of layer i / 4.
void placeInMask(Plan& plan)
{
    constexpr std::uint32_t kLuminance = 3;
    std::uint32_t shared_layer = 0;
    std::uint32_t next_channel = 4; // no layer is begun
    plan.mask_layers = 0;
    for (LightPlan& light : plan.lights) {
        light.mask_coloured = (*plan.options)[light.options].asked().translucent == Translucent::colour;
        if (light.mask_coloured) {
            light.mask_layer = plan.mask_layers++;
            light.mask_channel = kLuminance;
            continue;
        }
        if (next_channel == 4) {
            shared_layer = plan.mask_layers++;
            next_channel = 0;
        }
        light.mask_layer = shared_layer;
        light.mask_channel = next_channel++;
    }
}

} // namespace

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
    takes_turns = std::ranges::any_of(setups, [](const Setup& one) { return one.recipe.takesTurns(); });
    plan.options = std::move(resolved);
}

Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

void Planner::reset()
{
    if (impl_ != nullptr) {
        impl_->store.forget();
        impl_->settled = false;
        impl_->chooser = {};
        impl_->multi = {};
        impl_->turns.forget();
        impl_->scene.forget();
    }
}

void Planner::lost(const MapId& map)
{
    if (impl_ != nullptr) {
        impl_->store.lost(map);
        impl_->settled = false;
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
    if (s.repeats(given)) {
        s.repeatPlan(given);
        return s.plan;
    }
    if (s.spoilt) { // nobody knows what the maps hold, nor whose they are
        MapStore fresh;
        s.addPages(fresh);
        s.store = std::move(fresh);
        std::swap(s.suns, s.suns_before);
        s.chooser = {};
        s.multi = {};
        s.moved.forget();
        s.turns.forget();
        s.scene.forget();
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
    const bool again = s.told.holds(frame) && !frame.cut;
    s.setNearDistances(frame);
    s.makePlan(frame);
    frame.lights = given.lights;
    s.told.note(frame);
    // What remembers (AutoChooser, MultiPartition) has had its say on the same frame twice.
    s.settled =
        again &&
        std::ranges::none_of(s.plan.views, [](const View& view) { return view.redraw || view.faded_in < 1.0; }) &&
        std::ranges::none_of(s.plan.lights, [](const LightPlan& light) { return light.waited > 0; });
    s.spoilt = false;
    return s.plan;
}

/// Would the frame's plan be the last one? Not where it depends on time, or is of another sample of the light.
bool Planner::Impl::repeats(const Frame& frame) const
{
    return settled && !spoilt && !frame.cut && told.holds(frame) &&
           std::ranges::none_of(setups, [](const Setup& setup) {
               return setup.recipe.converges() ||
                      (setup.recipe.motion != nullptr && setup.recipe.motion->stepping != Stepping::none);
           });
}

void Planner::Impl::repeatPlan(const Frame& frame)
{
    plan.frame = frame.index;
    plan.cut = false;
    plan.number = ++frames;
    ++converging;
}

void Planner::Impl::addPages(MapStore& to) const
{
    for (const Setup& setup : setups) {
        const std::uint64_t side = setup.recipe.resolved.largest_side();
        const std::uint64_t budget = setup.recipe.options.budget_texels;
        const std::uint64_t most = setup.recipe.options.max_layers;
        to.addPages(static_cast<std::uint32_t>(side),
                    static_cast<std::uint32_t>(budget == 0 ? most : std::min(most, budget / (side * side))));
    }
}

void Planner::Impl::makePlan(const Frame& frame)
{
    some_nowhere = frame.objects->nowhere() > 0;
    begin(frame);
    scene.follow(*frame.objects);
    noteMovement(frame);
    admit(frame);
    placeInMask(plan);
    listReceivers(frame);
    store.follow(*frame.objects, keys);
    shareRoom(frame);
    keepRoomOfTurns();
    suns.begin();
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
        planLight(frame, light);
    }
    suns.end();
    takeTurns(frame);
    drawViews(frame);
    reportRoom();
    ++frames;
    ++converging;
}

void Planner::Impl::begin(const Frame& frame)
{
    plan.frame = frame.index;
    plan.lights.clear();
    if (takes_turns) {
        std::swap(plan.views, turns.views);
        std::swap(plan.casters, turns.casters);
    }
    plan.views.clear();
    plan.casters.clear();
    plan.object_ids.clear();
    plan.object_bounds.clear();
    plan.object_pieces.clear();
    view_maps.clear();
    for (Setup& setup : setups) {
        setup.looked = false;
        setup.wide.looked = false;
    }
}

/// Where lights do not say how near their casters begin, the bounds of what casts do.
void Planner::Impl::setNearDistances(Frame& frame)
{
    if (fault.kind != OutcomeKind::ok || frame.objects->bounds().empty()) {
        return;
    }
    lights.assign(frame.lights.begin(), frame.lights.end());
    for (Light& light : lights) {
        if (light.type != LightType::directional && light.near_m == 0.0 && checkLight(light).kind == OutcomeKind::ok) {
            light.near_m = nearBefore(light, *frame.objects, near_casters);
        }
    }
    frame.lights = lights;
}

/// Which plan this is, and what of the pictures before it still holds.
void Planner::Impl::noteMovement(const Frame& frame)
{
    plan.cut = frame.cut || frames == 0;
    camera_moves = plan.cut || !told.sees(frame);
    plan.number = frames + 1;
    plan.moved_ws.clear();
    if (std::ranges::any_of(setups, [](const Setup& setup) { return setup.recipe.converges(); })) {
        plan.cut = !moved.follow(*frame.objects, plan.moved_ws) || plan.cut;
    }
    converging = plan.cut ? 0 : converging;
}

void Planner::Impl::admit(const Frame& frame)
{
    look(frame, setups[0]);
    own_wishes.assign(frame.lights.size(), {});
    in_reach.clear();
    reach_ends.clear();
    chooser.follow(frame.lights);
    multi.follow(frame.lights);
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        const Light& light = frame.lights[index];
        LightPlan& planned = plan.lights.emplace_back();
        reach_ends.push_back(static_cast<std::uint32_t>(in_reach.size()));
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
        if (planned.outcome.kind == OutcomeKind::ok && setup.recipe.layersWorld()) {
            planned.outcome = layer(frame, setup);
        }
        if (planned.outcome.kind != OutcomeKind::ok) {
            continue;
        }
        look(frame, setup);
        listInReach(frame, light);
        reach_ends.back() = static_cast<std::uint32_t>(in_reach.size());
        if (!setup.recipe.hasMaps()) {
            continue;
        }
        if (setup.recipe.grows()) {
            divide(frame, index);
        } else {
            own_wishes[index] = decide(frame, index);
        }
    }
    foreseeTurns(frame);
    listTenants(frame);
}

/// Which layers of the world this frame's are: the options', the frame's, or found.
Outcome Planner::Impl::layer(const Frame& frame, Setup& setup)
{
    const MomentOptions& moments = setup.recipe.options.moments;
    const auto given = std::span(moments.world_layers).first(moments.layers);
    if (given.front() != WorldLayer{} || given.back() != WorldLayer{}) {
        setup.layers.assign(given.begin(), given.end());
        return {};
    }
    if (frame.layers.empty() && moments.layer_axis == LayerAxis::light) {
        return {OutcomeKind::refused, "lvsm.axis light: layers that are found are layers of height; give those along "
                                      "the light by lvsm.world or Frame::layers"};
    }
    const std::span<const WorldLayer> layers =
        frame.layers.empty() ? scene.layers(*frame.objects, moments.layers) : frame.layers;
    if (!frame.layers.empty() && (layers.size() != moments.layers || refusal(layers))) {
        return {OutcomeKind::refused, "Frame::layers are not as many as the options' layers, from low to high, both "
                                      "ends of each above those of the one before"};
    }
    setup.layers.assign(layers.begin(), layers.end());
    return {};
}

/// Many lamps reach few objects each, so each of them asks for its own.
void Planner::Impl::listInReach(const Frame& frame, const Light& light)
{
    const Setup& setup = setups[light.options];
    if (light.type == LightType::directional || setup.camera.outcome.kind != OutcomeKind::ok ||
        setup.receivers.empty()) {
        return;
    }
    const Aabb reach =
        grown(reachBox(light, setup.camera.scene_ws), setup.camera.pad_m + light.radius_m); // sampledLight() moves it
    planes.assign(setup.camera.planes.begin(), setup.camera.planes.end());
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        planes.push_back({normal, -static_cast<double>(reach.min[axis])});
        planes.push_back({-normal, static_cast<double>(reach.max[axis])});
    }
    const auto first = static_cast<std::ptrdiff_t>(in_reach.size());
    frame.objects->query(planes, ObjectSet::Want::receivers, in_reach);
    if (setup.recipe.options.max_distance_m > 0.0) { // which is finer than planes
        const auto far = std::remove_if(in_reach.begin() + first, in_reach.end(), [&](std::uint32_t object) {
            return !std::ranges::binary_search(setup.receivers, object);
        });
        in_reach.erase(far, in_reach.end());
    }
}

std::span<const std::uint32_t> Planner::Impl::receiversOf(std::uint32_t index, const Light& light) const
{
    if (light.type == LightType::directional) {
        return setups[light.options].receivers;
    }
    const std::uint32_t first = index > 0 ? reach_ends[index - 1] : 0;
    return std::span(in_reach).subspan(first, reach_ends[index] - first);
}

void Planner::Impl::divide(const Frame& frame, std::uint32_t index)
{
    const Light light = sampledLight(frame.lights[index], sampleAt(frame, index)); // where its maps are drawn from
    const Setup& setup = setups[light.options];
    if (setup.camera.outcome.kind == OutcomeKind::ok && !setup.receivers.empty()) {
        multi.divide({frame, setup.recipe, setup.camera, receiversOf(index, light), setup.sight, light}, index,
                     frustums);
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
        plan.lights[index].choice = chooser
                                        .decide({frame, recipe, setup.camera, receiversOf(index, light),
                                                 receiversOf(index, light), light, none},
                                                setup.sight, index, frustums)
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
    setup.sighted = false;
    CameraView& camera = setup.camera;
    const ShadowOptions& options = setup.recipe.options;
    camera.look(frame, options.max_distance_m, setup.receivers);
    if (camera.outcome.kind != OutcomeKind::ok || setup.receivers.empty()) {
        return;
    }
    setup.sighted = setup.recipe.predicts() || setup.recipe.grows() || setup.recipe.warps();
    if (setup.sighted) {
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

} // namespace gnomon
