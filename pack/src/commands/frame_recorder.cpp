// SPDX-License-Identifier: Apache-2.0
#include "commands/map_commands.h"
#include "commands/mask_commands.h"
#include "commands/supported.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_commands.h>
#include <gnomon/pack/frame_passes.h>
#include <gnomon/plan_views.h>

#include <algorithm>

namespace gnomon::pack {
namespace {

/// Can maps with the one options go on with the other? Only what they are made by counts.
bool areAlike(const ResolvedOptions& a, const ResolvedOptions& b)
{
    return a.filter() == b.filter() && a.format() == b.format() && (!a.filterable() || a.moments() == b.moments());
}

} // namespace

struct FrameRecorder::Impl {
    explicit Impl(const RecorderTraits& given) : traits(given), mask(recording, traits) {}

    /// Forgets what maps hold.
    void lose()
    {
        for (std::uint32_t i = 0; i < classes.size(); ++i) {
            notes.lose(i);
        }
    }
    void loseImages();
    /// Calls `record`; where that throws, a list is half recorded, and images and buffers are made anew.
    template <class Record>
    void guarded(const Record& record)
    {
        try {
            record();
        } catch (...) {
            loseImages();
            throw;
        }
    }
    void matchClasses(const Plan& plan);
    bool prepare(const Plan& plan, glm::uvec2 size_px);
    void drawMaps(const Plan& plan);
    void check(const char* tried, const Plan& plan) const;

    RecorderTraits traits;
    Recording recording;
    MaskCommands mask;
    std::vector<std::unique_ptr<MapCommands>> classes; // by options; null where no light names them
    std::vector<ResolvedOptions> class_for;            // the options that they were made for, by options
    MapNotes notes;
    std::uint64_t planner = 0;
    bool has_mask = false;
    RecordedMaps recorded;
};

/// Options that are others than those of the last plan lose their maps, unless these are made in the same way.
void FrameRecorder::Impl::matchClasses(const Plan& plan)
{
    for (std::uint32_t i = 0; i < classes.size(); ++i) {
        const bool goes_on = i < plan.options->size() && areAlike(class_for[i], (*plan.options)[i]);
        if (classes[i] && !goes_on) {
            classes[i].reset();
            recording.drop(i);
            notes.lose(i);
        }
    }
    classes.resize(std::max(classes.size(), plan.options->size()));
    class_for.resize(classes.size(), plan.options->front());
    std::copy(plan.options->begin(), plan.options->end(), class_for.begin());
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if (!classes[i] && hasLights(plan, i)) {
            classes[i] = makeMapCommands(recording, traits, (*plan.options)[i], i);
        }
    }
}

void FrameRecorder::Impl::check(const char* tried, const Plan& plan) const
{
    checkPlan(tried, plan);
    checkSupported(tried, plan);
    for (const View& view : plan.views) {
        const std::uint32_t options = optionsIndexOf(plan, view);
        const bool there = options < classes.size() && classes[options] &&
                           areAlike(class_for[options], (*plan.options)[options]) &&
                           classes[options]->covers(plan, view);
        if (!there) {
            throw Error(tried, "the plan needs other textures than the last prepare() made", "call prepare() for it");
        }
    }
}

bool FrameRecorder::Impl::prepare(const Plan& plan, glm::uvec2 size_px)
{
    if (planner != plan.planner) { // another planner may give out the same names
        lose();
    }
    planner = plan.planner;
    matchClasses(plan);
    notes.reserve(plan);
    bool changed = false;
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if (classes[i]) {
            const MapCommands::Prepared prepared = classes[i]->prepare(plan);
            changed = changed || prepared.changed;
            if (prepared.lost) {
                notes.lose(i);
            }
        }
    }
    has_mask = size_px.x > 0 && size_px.y > 0;
    const bool mask_changed = has_mask && mask.prepare(plan, size_px);
    return changed || mask_changed;
}

void FrameRecorder::Impl::drawMaps(const Plan& plan)
{
    const std::span<const ViewWork> work = notes.workFor(plan);
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if (classes[i]) {
            classes[i]->draw({plan, i, work});
        }
    }
    recorded = {};
    for (std::size_t i = 0; i < work.size(); ++i) {
        const bool keeps = plan.views[i].contents.kept_layer != kNoIndex;
        recorded.held += work[i].draw ? 0 : 1;
        recorded.drawn += work[i].draw && !keeps ? 1 : 0;
        recorded.restored += work[i].draw && keeps ? 1 : 0;
        recorded.kept_drawn += work[i].draw_kept ? 1 : 0;
    }
    notes.done(plan);
}

void FrameRecorder::Impl::loseImages()
{
    lose();
    classes.clear();
    class_for.clear();
    recording.forget();
    mask.forget();
    has_mask = false;
}

FrameRecorder::FrameRecorder(const RecorderTraits& traits) : impl_(std::make_unique<Impl>(traits)) {}

FrameRecorder::~FrameRecorder() = default;

bool FrameRecorder::prepare(const Plan& plan, glm::uvec2 size_px, CommandList& out)
{
    constexpr const char* kTried = "prepare for a plan";
    checkPlan(kTried, plan);
    checkSupported(kTried, plan);
    impl_->recording.to(out);
    bool changed = false;
    impl_->guarded([&] { changed = impl_->prepare(plan, size_px); });
    return changed;
}

void FrameRecorder::drawMaps(const Plan& plan, CommandList& out)
{
    impl_->check("draw shadow maps", plan);
    impl_->recording.to(out);
    impl_->guarded([&] { impl_->drawMaps(plan); });
}

void FrameRecorder::drawMask(const Plan& plan, const RecorderInputs& inputs, CommandList& out)
{
    constexpr const char* kTried = "draw the mask";
    Impl& impl = *impl_;
    impl.check(kTried, plan);
    if (!impl.has_mask || !impl.mask.holds(plan)) {
        throw Error(kTried, "the last prepare() made no mask of this size for this plan", "call prepare() for it");
    }
    if (plan.made_for.lights.size() != plan.lights.size()) {
        throw Error(kTried, "the frame that the plan was made for has other lights", "hand in the planner's own plan");
    }
    impl.recording.to(out);
    impl.guarded([&] { impl.mask.draw(plan, inputs); });
}

void FrameRecorder::lose()
{
    impl_->lose();
}

void FrameRecorder::loseImages()
{
    impl_->loseImages();
}

ImageShape FrameRecorder::shapeOf(const ImageRef& image) const
{
    return impl_->recording.shapeOf(image);
}

RecordedMaps FrameRecorder::recorded() const
{
    return impl_->recorded;
}

} // namespace gnomon::pack
