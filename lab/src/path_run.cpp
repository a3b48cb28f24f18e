// SPDX-License-Identifier: Apache-2.0
#include "lab/path_run.h"

#include "lab/traffic.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace gnomon::lab {
namespace {

/// The data of a frame that the next one needs.
struct Before {
    Camera camera;
    truth::Surfaces surfaces;
    Counted counted;
};

/// The matches of a frame's pixels in the last frame.
struct Matches {
    Reprojection onto_before;
    std::optional<Reprojection> onto_here;
};

struct Walker {
    host::RenderOptions options;
    std::unique_ptr<host::FrameRenderer> renderer;
    PathScore score;
    StabilityMeter meter;
    Timed timed;
    std::vector<ShownFrame> shown;
    std::optional<ImageF> error_here; // the error of the frame before, by revisit()
};

/// Can the moment of its last frame be drawn once more and leave it as it was?
bool canBeRevisited(const host::RenderOptions& options)
{
    return options.shadow.technique.motion != Motion::step_alternate && !fitsOnGpu(options.shadow);
}

} // namespace

ShownFrame shownOf(Score& score)
{
    ShownFrame shown;
    shown.classes = score.classification
                        ? std::move(score.classification->classes)
                        : ImageOf<ErrorClass>(score.mask.width, score.mask.height, 1, ErrorClass::left_out);
    shown.mask = std::move(score.mask);
    shown.counted = std::move(score.pixels.counted);
    return shown;
}

struct PathRun::Impl {
    std::vector<Walker> walkers; // the first draws without shadows
    glm::uvec2 size_px{0};
    std::uint32_t frames = 0;
    std::optional<Before> before;
    std::optional<Before> here; // the frame before, from where the one to come is seen
    double squared_noise = 0.0;
    std::uint64_t noisy_frames = 0;
    std::uint64_t baseline_bytes = 0;

    void draw(const Subject& subject);
    void score(Walker& walker, const Subject& subject, const truth::Traced& truth, bool show,
               std::optional<Matches>& matches, Counted& counted) const;
};

PathRun::PathRun(const host::SceneOnGpu& scene, glm::uvec2 size_px, const std::vector<Contestant>& contestants)
    : impl_(std::make_unique<Impl>())
{
    assert(!contestants.empty());
    impl_->size_px = size_px;
    impl_->walkers.resize(contestants.size() + 1);
    for (std::size_t i = 0; i < impl_->walkers.size(); ++i) {
        Walker& walker = impl_->walkers[i];
        walker.options = judgedOptions(contestants[i == 0 ? 0 : i - 1].options, size_px);
        walker.options.shadows = i != 0;
        walker.renderer = std::make_unique<host::FrameRenderer>(scene, walker.options);
    }
}

PathRun::~PathRun() = default;

void PathRun::Impl::draw(const Subject& subject)
{
    for (const std::size_t place : turnsOf(frames, walkers.size())) {
        Walker& walker = walkers[place];
        const host::FrameTimes times = walker.renderer->draw(*subject.state, subject.eye, subject.lights);
        if (frames == 1) {
            walker.timed = {.added_memory = std::move(walker.timed.added_memory)}; // it made pipelines and room
        }
        walker.timed.samples.push_back(times);
        addTexels(walker.timed, countersOf(times, walker.renderer->plan(), !walker.options.reuse_maps));
    }
    if (frames == 0) { // before anything is read back, which takes memory
        baseline_bytes = totalBytes(*walkers.front().renderer);
        for (Walker& walker : walkers) {
            walker.timed.added_memory = addedMemory(*walker.renderer, *walkers.front().renderer);
        }
    }
}

void PathRun::Impl::score(Walker& walker, const Subject& subject, const truth::Traced& truth, bool show,
                          std::optional<Matches>& matches, Counted& counted) const
{
    Score score = scoreDrawn(*walker.renderer, subject, truth, walker.options);
    if (counted.values.empty()) { // all renderers see the same objects
        counted = score.pixels.counted;
        if (before) {
            const Camera camera = host::cameraOf(subject.eye, size_px.x, size_px.y, subject.state->bounds_ws);
            const SeenFrame now{camera, truth.surfaces, counted};
            matches.emplace(Matches{Reprojection(now, {before->camera, before->surfaces, before->counted}), {}});
            if (here) {
                matches->onto_here.emplace(now, SeenFrame{here->camera, here->surfaces, here->counted});
            }
        }
    }
    std::optional<FrameBefore> then;
    if (matches) {
        then.emplace(FrameBefore{matches->onto_before});
        if (matches->onto_here && walker.error_here) {
            then->here = &*matches->onto_here;
            then->error_here = &*walker.error_here;
        }
    }
    walker.meter.add(score.mask, truth.visibility.visibility, then ? &*then : nullptr);
    walker.error_here.reset();
    walker.score.add(score);
    if (show) {
        walker.shown.push_back(shownOf(score));
    }
}

void PathRun::add(const Subject& subject, truth::Traced truth, bool show, const std::function<void()>& step)
{
    assert(subject.light == 0 && subject.lights.size() == 1);
    impl_->draw(subject);
    std::optional<Matches> matches;
    Counted counted;
    for (std::size_t i = 1; i < impl_->walkers.size(); ++i) {
        impl_->score(impl_->walkers[i], subject, truth, show, matches, counted);
        if (step) {
            step();
        }
    }
    if (const auto noise = truthNoise(truth.visibility, counted)) {
        impl_->squared_noise += *noise * *noise;
        ++impl_->noisy_frames;
    }
    const glm::uvec2 size_px = impl_->size_px;
    impl_->before = Before{host::cameraOf(subject.eye, size_px.x, size_px.y, subject.state->bounds_ws),
                           std::move(truth.surfaces), std::move(counted)};
    impl_->here.reset();
    ++impl_->frames;
}

void PathRun::revisit(const Subject& subject, const truth::Traced& truth)
{
    assert(impl_->frames != 0);
    const glm::uvec2 size_px = impl_->size_px;
    for (std::size_t i = 1; i < impl_->walkers.size(); ++i) {
        Walker& walker = impl_->walkers[i];
        if (!canBeRevisited(walker.options)) {
            continue;
        }
        walker.renderer->drawAgain(*subject.state, subject.eye, subject.lights);
        const bool first = !impl_->here;
        const host::Picture picture = walker.renderer->read({.colour = false, .masks = true, .geometry = first});
        walker.error_here = errorOf(picture.masks[subject.light], truth.visibility.visibility);
        if (first) { // all renderers see the same objects
            impl_->here = Before{host::cameraOf(subject.eye, size_px.x, size_px.y, subject.state->bounds_ws),
                                 truth.surfaces, countPixels(subject, truth.surfaces, picture).counted};
        }
    }
}

std::optional<double> PathRun::noise() const
{
    return impl_->noisy_frames == 0
               ? std::nullopt
               : std::optional(std::sqrt(impl_->squared_noise / static_cast<double>(impl_->noisy_frames)));
}

PathRun::Result PathRun::finish(const Subject& last)
{
    assert(impl_->frames != 0);
    Result result;
    result.baseline_bytes = impl_->baseline_bytes;
    const double baseline_ms = medianFrame(impl_->walkers.front().timed);
    for (Walker& walker : impl_->walkers) {
        Timed& timed = walker.timed;
        timed.plan = walker.renderer->plan();
        timed.atlas = timed.plan.pages[0];
        timed.counters = countersOf(timed.samples.back(), timed.plan, !walker.options.reuse_maps);
        timed.counters.filter = walker.renderer->filterCost();
        timed.least = leastByPass(*walker.renderer, walker.options);
        timed.counters.bytes_minimum = leastBytes(walker.renderer->read({.colour = false, .geometry = true}),
                                                  *walker.renderer, last, walker.options);
        timed.baseline_ms = baseline_ms;
    }
    result.baseline = std::move(impl_->walkers.front().timed);
    for (std::size_t i = 1; i < impl_->walkers.size(); ++i) {
        Walker& walker = impl_->walkers[i];
        PathTechnique technique;
        technique.score = walker.score.mean();
        technique.stability = walker.meter.stability();
        technique.rmse = walker.score.rmse();
        technique.steps = walker.meter.steps();
        technique.timed = std::move(walker.timed);
        technique.shown = std::move(walker.shown);
        result.techniques.push_back(std::move(technique));
    }
    return result;
}

} // namespace gnomon::lab
