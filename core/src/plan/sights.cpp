// SPDX-License-Identifier: Apache-2.0
#include "plan/sights.h"

#include "light_reach.h"
#include "region.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace gnomon {

Sights::Sights(std::span<const ShadowOptions> options)
{
    static const ShadowOptions defaults;
    for (const ShadowOptions& one : options.empty() ? std::span(&defaults, 1) : options) {
        setups_.emplace_back(one);
    }
}

void Sights::mend()
{
    std::swap(suns_, suns_before_);
    moved_.forget();
    scene_.forget();
}

void Sights::see(const Frame& frame, const Outcome& fault, const FramesBefore& before, Plan& plan)
{
    begin(frame, plan);
    setNearDistances(fault);
    scene_.follow(*frame.objects);
    noteMovement(plan);
    look(setups_[0]);
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        addLight(index, fault, plan);
    }
    suns_.begin();
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        followSun(index, before, plan.lights[index]);
    }
    suns_.end();
    listReceivers(plan);
}

void Sights::begin(const Frame& frame, Plan& plan)
{
    frame_ = frame;
    lights_.assign(frame.lights.size(), {});
    in_reach_.clear();
    for (Setup& setup : setups_) {
        setup.looked = false;
    }
    plan.lights.clear();
    plan.made_for.camera = frame.camera;
    plan.made_for.size_px = frame.size_px;
    plan.made_for.lights.assign(frame.lights.begin(), frame.lights.end());
    plan.made_for.scene_ws = frame.objects->bounds();
    plan.made_for.objects = frame.objects->identity();
    plan.made_for.version = frame.objects->version();
}

/// Where lights do not say how near their casters begin, the bounds of what casts do.
void Sights::setNearDistances(const Outcome& fault)
{
    if (fault.kind != OutcomeKind::ok || frame_.objects->bounds().empty()) {
        return;
    }
    near_lights_.assign(frame_.lights.begin(), frame_.lights.end());
    for (Light& light : near_lights_) {
        if (light.type != LightType::directional && light.near_m == 0.0 && checkLight(light).kind == OutcomeKind::ok) {
            light.near_m = nearBefore(light, *frame_.objects, near_casters_);
        }
    }
    frame_.lights = near_lights_;
}

/// Pictures that are averaged begin anew where too much has moved.
void Sights::noteMovement(Plan& plan)
{
    plan.moved_ws.clear();
    if (std::ranges::any_of(setups_, [](const Setup& setup) { return setup.recipe.converges(); })) {
        plan.cut = !moved_.follow(*frame_.objects, plan.moved_ws) || plan.cut;
    }
    converging_ = plan.cut ? 0 : converging_;
}

void Sights::addLight(std::uint32_t index, const Outcome& fault, Plan& plan)
{
    const Light& light = frame_.lights[index];
    LightPlan& planned = plan.lights.emplace_back();
    LightSight& sight = lights_[index];
    sight.first_receiver = static_cast<std::uint32_t>(in_reach_.size());
    if (fault.kind != OutcomeKind::ok) {
        planned.outcome = fault;
        return;
    }
    if (light.options >= setups_.size()) {
        planned.outcome = {OutcomeKind::refused, "Light::options names none of the planner's options"};
        return;
    }
    planned.options = light.options;
    Setup& setup = setups_[light.options];
    planned.outcome = check(light, setup);
    if (planned.outcome.kind == OutcomeKind::ok) {
        look(setup);
        listInReach(light);
        sight.receiver_count = static_cast<std::uint32_t>(in_reach_.size()) - sight.first_receiver;
        sight.sample = sampleOf(light, setup.recipe);
    }
}

Outcome Sights::check(const Light& light, Setup& setup)
{
    const Outcome outcome = setup.recipe.check(light);
    return outcome.kind == OutcomeKind::ok && setup.recipe.layersWorld() ? layer(setup) : outcome;
}

/// Which layers of the world this frame's are: the options', the frame's, or found.
Outcome Sights::layer(Setup& setup)
{
    const MomentOptions& moments = setup.recipe.options().moments;
    const auto given = std::span(moments.world_layers).first(moments.layers);
    if (given.front() != WorldLayer{} || given.back() != WorldLayer{}) {
        setup.layers.assign(given.begin(), given.end());
        return {};
    }
    if (frame_.layers.empty() && moments.layer_axis == LayerAxis::light) {
        return {OutcomeKind::refused, "lvsm.axis light: layers that are found are layers of height; give those along "
                                      "the light by lvsm.world or Frame::layers"};
    }
    const std::span<const WorldLayer> layers =
        frame_.layers.empty() ? scene_.layers(*frame_.objects, moments.layers) : frame_.layers;
    if (!frame_.layers.empty() && (layers.size() != moments.layers || refusal(layers))) {
        return {OutcomeKind::refused, "Frame::layers are not as many as the options' layers, from low to high, both "
                                      "ends of each above those of the one before"};
    }
    setup.layers.assign(layers.begin(), layers.end());
    return {};
}

void Sights::look(Setup& setup)
{
    if (setup.looked) {
        return;
    }
    setup.looked = true;
    setup.sighted = false;
    CameraView& camera = setup.camera;
    const Recipe& recipe = setup.recipe;
    camera.look(frame_, recipe.options().max_distance_m, setup.receivers);
    if (!setup.sees()) {
        return;
    }
    setup.sighted = recipe.predicts() || recipe.grows() || recipe.hasPages() || recipe.warps();
    if (setup.sighted) {
        setup.sight.look(frame_, camera, setup.receivers);
    }
    if (recipe.steady()) {
        camera.boundDepths(frame_.camera, recipe.options().max_distance_m);
    } else if (recipe.partition != nullptr && recipe.partition->measures) {
        camera.measureDepths(*frame_.objects, setup.receivers);
    } else {
        return;
    }
    if (!std::isfinite(camera.far_m - camera.near_m)) {
        camera.outcome = {OutcomeKind::degenerate, "the camera's numbers leave no depths to divide"};
    }
}

/// Many lamps reach few objects each, so each of them asks for its own.
void Sights::listInReach(const Light& light)
{
    const Setup& setup = setups_[light.options];
    if (light.type == LightType::directional || !setup.sees()) {
        return;
    }
    const Aabb reach =
        grown(reachBox(light, setup.camera.scene_ws), setup.camera.pad_m + light.radius_m); // sampledLight() moves it
    planes_.assign(setup.camera.planes.begin(), setup.camera.planes.end());
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        planes_.push_back({normal, -static_cast<double>(reach.min[axis])});
        planes_.push_back({-normal, static_cast<double>(reach.max[axis])});
    }
    const auto first = static_cast<std::ptrdiff_t>(in_reach_.size());
    frame_.objects->query(planes_, ObjectSet::Want::receivers, in_reach_);
    if (setup.recipe.options().max_distance_m > 0.0) { // which is finer than planes
        const auto far = std::remove_if(in_reach_.begin() + first, in_reach_.end(), [&](std::uint32_t object) {
            return !std::ranges::binary_search(setup.receivers, object);
        });
        in_reach_.erase(far, in_reach_.end());
    }
}

std::span<const std::uint32_t> Sights::receiversOf(std::uint32_t light) const
{
    if (frame_.lights[light].type == LightType::directional) {
        return setups_[frame_.lights[light].options].receivers;
    }
    return std::span(in_reach_).subspan(lights_[light].first_receiver, lights_[light].receiver_count);
}

/// Where a sun that moves in steps stands for its maps.
void Sights::followSun(std::uint32_t index, const FramesBefore& before, LightPlan& planned)
{
    const Light& light = frame_.lights[index];
    const Recipe& recipe = setups_[planned.options].recipe;
    if (!recipe.hasMaps() || !recipe.steps(light) || checkLight(light).kind != OutcomeKind::ok) {
        return;
    }
    const SunCourse& course =
        suns_.follow(light, frame_.time_s, recipe.motion->stepping, recipe.options().steps, before.camera_moves);
    planned.steps = course.steps();
    // By turns of the slots, not of the positions: then after a step too the frame before has read the other one, or
    // the one whose weight was next to nothing.
    planned.steps.read = (before.count & 1) == course.earlierSlot() ? SunPosition::earlier : SunPosition::later;
    lights_[index].earlier_slot = course.earlierSlot();
}

LightSample Sights::sampleOf(const Light& light, const Recipe& recipe) const
{
    LightSample sample;
    if (recipe.converges()) {
        sample = gnomon::sampleOf(light, convergeSample(recipe.resolved.integratesLight() ? 0 : converging_));
        sample.number = static_cast<std::uint32_t>(converging_ % 1024);
    }
    return sample;
}

/// Lists the receivers that the camera sees by any of the options that count in this frame.
void Sights::listReceivers(Plan& plan)
{
    plan.receivers.clear();
    all_receivers_.clear();
    bool levels = false;
    for (const Setup& setup : setups_) {
        if (!setup.looked) {
            continue;
        }
        levels = levels || (setup.recipe.steady() && setup.recipe.levelsDepth());
        if (plan.receivers.empty()) {
            plan.receivers.assign(setup.receivers.begin(), setup.receivers.end());
            continue;
        }
        merged_.clear();
        std::ranges::set_union(plan.receivers, setup.receivers, std::back_inserter(merged_));
        std::swap(plan.receivers, merged_);
    }
    if (levels) {
        frame_.objects->query({}, ObjectSet::Want::receivers, all_receivers_);
    }
}

const LightShares& Sights::findShares(std::uint32_t options)
{
    Setup& setup = setups_[options];
    if (setup.sees() && !setup.sighted) {
        setup.sight.look(frame_, setup.camera, setup.receivers);
        setup.sighted = true;
    }
    shares_.find(frame_.lights, setup.camera, setup.sees() ? setup.sight.points() : std::span<const SightPoint>());
    return shares_;
}

} // namespace gnomon
