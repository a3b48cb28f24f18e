// SPDX-License-Identifier: Apache-2.0
// A frame's way to its plan, in five steps: what is seen (Sights), how lights are divided (Frustums), where their maps
// lie (Places), how each is projected (Views), and what is drawn (Schedule). Where lights take turns, Schedule is asked
// before furnishing and while fitting, too.
#include "frame_memory.h"
#include "plan/frustums.h"
#include "plan/places.h"
#include "plan/schedule.h"
#include "plan/sights.h"
#include "plan/views.h"

#include <gnomon/planner.h>
#include <gnomon/world_range.h>

#include <algorithm>
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

/// At rest pages follow the picture for so many frames. By then those that are there stay (PageTree).
constexpr std::uint32_t kFramesOfPages = 16;

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

std::shared_ptr<const std::vector<ResolvedOptions>> resolvedOf(const std::vector<Setup>& setups)
{
    auto resolved = std::make_shared<std::vector<ResolvedOptions>>();
    for (const Setup& setup : setups) {
        resolved->push_back(setup.recipe.resolved);
    }
    return resolved;
}

} // namespace

struct Planner::Impl {
    /// Without any options it has the default ones, and `unusable` says why nobody plans by them.
    explicit Impl(std::span<const ShadowOptions> options, Outcome why_unusable = {})
        : unusable(why_unusable), sights(options), places(sights.setups()), schedule(sights.setups())
    {
        plan.options = resolvedOf(sights.setups());
    }

    Outcome unusable; // not ok: no light has a map, in any frame
    Sights sights;
    Frustums frustums;
    Places places;
    Views views;
    Schedule schedule;
    Plan plan;
    FrameMemory last_frame;   // that `plan` was made from
    std::uint64_t frames = 0; // planned so far
    bool settled = false;     // the plan would be made again: nothing in it was to be drawn or fading
    std::uint32_t rested = 0; // frames in which nothing changed, except for Frame::requests
    bool spoilt = false;      // a plan ended half way, because something threw

    [[nodiscard]] bool repeats(const Frame& frame) const;
    void repeatPlan(const Frame& frame);
    void makePlan(const Frame& frame, const Outcome& fault);
    [[nodiscard]] bool settles() const;
    void forget();
};

Planner::Planner() : Planner(ShadowOptions{}) {}

Planner::Planner(const ShadowOptions& options) : Planner(std::span(&options, 1)) {}

Planner::Planner(std::span<const ShadowOptions> options) : impl_(std::make_unique<Impl>(options, noOptions(options))) {}

Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

void Planner::reset()
{
    if (impl_ != nullptr) {
        impl_->places.store().forget();
        impl_->settled = false;
        impl_->forget();
    }
}

void Planner::lost(const MapId& map)
{
    if (impl_ != nullptr) {
        impl_->places.store().lost(map);
        impl_->settled = false;
    }
}

const ShadowOptions& Planner::options(std::uint32_t index) const
{
    static const ShadowOptions defaults;
    return impl_ != nullptr && index < impl_->sights.setups().size() ? impl_->sights.setups()[index].recipe.asked
                                                                     : defaults;
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
    if (s.spoilt) {
        s.places.renew(s.sights.setups());
        s.sights.mend();
        s.forget();
        s.spoilt = false;
    }
    Frame frame = given;
    Outcome fault = s.unusable;
    if (frame.objects == nullptr) {
        fault = {OutcomeKind::degenerate, "the frame has no objects: Frame::objects is null"};
        frame.objects = &no_objects;
    }
    if (fault.kind == OutcomeKind::ok) {
        fault = checkRange(*frame.objects);
    }
    s.sights.remember();
    s.spoilt = true;
    const bool again = s.last_frame.holds(frame) && !frame.cut;
    s.rested = again ? s.rested + 1 : 0;
    s.makePlan(frame, fault);
    s.plan.made_for.objects = given.objects != nullptr ? s.plan.made_for.objects : 0;
    s.last_frame.note(frame);
    s.settled = again && s.settles();
    s.spoilt = false;
    return s.plan;
}

/// Nothing is known of frames before.
void Planner::Impl::forget()
{
    sights.forget();
    frustums.forget();
    schedule.forget();
    rested = 0;
}

void Planner::Impl::makePlan(const Frame& frame, const Outcome& fault)
{
    plan.frame = frame.index;
    plan.number = frames + 1;
    plan.cut = frame.cut || frames == 0;
    schedule.begin(plan);
    sights.see(frame, fault, {frames, plan.cut || !last_frame.sees(frame)}, plan);
    placeInMask(plan);
    frustums.divide(sights, rested, plan);
    schedule.foresee(sights, frustums, places, plan);
    frustums.list(sights, plan);
    places.furnish(sights, frustums);
    schedule.keepRoom(frustums, places);
    views.fit(sights, frustums, places, schedule, plan);
    schedule.take(sights, frustums, places, views.maps(), plan);
    places.report(frustums, plan);
    Schedule::report(plan);
    sights.passFrame();
    ++frames;
}

/// Where the same frame was planned twice: what remembers (AutoChooser, MultiPartition) has had its say.
bool Planner::Impl::settles() const
{
    return std::ranges::none_of(plan.views,
                                [](const View& view) { return view.contents.redraw || view.serves.faded_in < 1.0; }) &&
           std::ranges::none_of(plan.lights, [](const LightPlan& light) { return light.waited > 0; });
}

/// Would the frame's plan be the last one? Not where it depends on time, or is of another sample of the light. Pages
/// follow what is seen of themselves, and might do so for ever.
bool Planner::Impl::repeats(const Frame& frame) const
{
    return settled && !spoilt && !frame.cut && last_frame.holds(frame) &&
           std::ranges::none_of(sights.setups(), [this](const Setup& setup) {
               return setup.recipe.converges() || (setup.recipe.hasPages() && rested < kFramesOfPages) ||
                      (setup.recipe.motion != nullptr && setup.recipe.motion->stepping != Stepping::none);
           });
}

void Planner::Impl::repeatPlan(const Frame& frame)
{
    plan.frame = frame.index;
    plan.cut = false;
    plan.number = ++frames;
    sights.passFrame();
}

} // namespace gnomon
