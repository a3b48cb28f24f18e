// SPDX-License-Identifier: Apache-2.0
#include "compare_steps.h"

#include "app/visual.h"
#include "report_pictures.h"
#include "truth_run.h"

#include <algorithm>
#include <span>

namespace gnomon::app {
namespace {

std::vector<lab::Contestant> contestantsOf(const std::vector<Settings>& techniques)
{
    std::vector<lab::Contestant> contestants;
    contestants.reserve(techniques.size());
    for (const Settings& technique : techniques) {
        contestants.push_back({describeTechnique(technique), renderOptions(technique)});
    }
    return contestants;
}

/// First, middle and last, each once.
std::vector<std::uint32_t> shownFrames(const FrameRange& range)
{
    std::vector<std::uint32_t> frames;
    for (const std::uint32_t frame : {range.first, range.first + (range.last - range.first) / 2, range.last}) {
        if (frames.empty() || frames.back() != frame) {
            frames.push_back(frame);
        }
    }
    return frames;
}

bool isSameEye(const host::Eye& a, const host::Eye& b)
{
    return a.position_ws == b.position_ws && a.target_ws == b.target_ws && a.up_ws == b.up_ws &&
           a.fov_y_rad == b.fov_y_rad && a.height_m == b.height_m && a.near_m == b.near_m && a.far_m == b.far_m;
}

/// One walk of a group of techniques along the path.
class Walk {
public:
    Walk(const host::SceneOnGpu& scene, Shot& shot, const Settings& settings, CompareResult& result, bool first)
        : scene_(scene), shot_(shot), settings_(settings), result_(result), first_(first),
          light_(lightIndex(shot, settings))
    {
    }

    lab::PathRun::Result run(std::span<const lab::Contestant> contestants, const std::function<void()>& step)
    {
        const FrameRange range = *settings_.frames;
        TruthTracer tracer(shot_, settings_);
        std::optional<lab::PathRun> run;
        for (std::uint32_t frame = range.first; frame <= range.last; ++frame) {
            if (run) {
                revisit(*run, tracer, frame);
            }
            moveShot(shot_, settings_, frame);
            tracer.moved();
            TruthRun truth = tracer.trace(light_);
            const lab::Subject subject = subjectNow();
            if (!run) {
                run.emplace(scene_, settings_.size_px,
                            std::vector<lab::Contestant>(contestants.begin(), contestants.end()));
            }
            const std::vector<std::uint32_t>& shown = result_.path->shown;
            const bool show = !settings_.report.empty() && std::find(shown.begin(), shown.end(), frame) != shown.end();
            if (first_) {
                note(truth, frame == range.first, show);
            }
            run->add(subject, std::move(truth.traced), show, step);
        }
        if (first_) {
            result_.standard_error = run->noise();
        }
        return run->finish(subjectNow());
    }

private:
    /// Shows the run the frame before `frame` from where that will be seen, if the camera moves. Leaves the shot
    /// anywhere.
    void revisit(lab::PathRun& run, TruthTracer& tracer, std::uint32_t frame)
    {
        const host::Eye before = shot_.eye;
        moveShot(shot_, settings_, frame);
        const host::Eye eye = shot_.eye;
        if (isSameEye(eye, before)) {
            return;
        }
        moveShot(shot_, settings_, frame - 1);
        shot_.eye = eye;
        tracer.moved();
        run.revisit(subjectNow(), tracer.trace(light_).traced);
    }

    [[nodiscard]] lab::Subject subjectNow() const
    {
        return {&shot_.scene, &shot_.state, shot_.eye, {shot_.lights[light_]}, 0};
    }

    /// Adds one frame's truth to the facts of the result.
    void note(const TruthRun& truth, bool is_first, bool show)
    {
        const truth::Visibility& visibility = truth.traced.visibility;
        TruthFacts& facts = result_.judged.facts;
        if (is_first) {
            result_.judged.subject = subjectNow();
            facts = truthFacts(settings_, shot_.lights[light_].caster);
            facts.from_cache = true;
        }
        facts.rays += visibility.rays;
        facts.seconds += visibility.seconds;
        facts.from_cache = facts.from_cache && truth.from_cache;
        if (show) {
            result_.path->truths.push_back(visibility.visibility);
            result_.shades.push_back(drawShades(scene_, subjectNow(), settings_));
        }
    }

    const host::SceneOnGpu& scene_;
    Shot& shot_;
    const Settings& settings_;
    CompareResult& result_;
    bool first_;
    std::size_t light_;
};

} // namespace

std::uint64_t pathSteps(const Settings& settings, const std::vector<Settings>& techniques)
{
    const std::uint64_t frames = std::uint64_t{settings.frames->last} - settings.frames->first + 1;
    return frames * techniques.size();
}

void comparePath(const host::SceneOnGpu& scene, Shot& shot, const Settings& settings,
                 const std::vector<Settings>& techniques, CompareResult& result, const std::function<void()>& step)
{
    result.path.emplace();
    result.path->name = settings.path;
    result.path->frames = *settings.frames;
    result.path->shown = shownFrames(*settings.frames);
    const std::vector<lab::Contestant> contestants = contestantsOf(techniques);
    std::size_t next = 0;
    for (const std::size_t count : lab::timingGroups(contestants, 1)) {
        Walk walk(scene, shot, settings, result, next == 0);
        lab::PathRun::Result walked = walk.run(std::span(contestants).subspan(next, count), step);
        for (std::size_t i = 0; i < count; ++i, ++next) {
            lab::PathTechnique& one = walked.techniques[i];
            ComparedTechnique compared;
            compared.settings = techniques[next];
            compared.name = contestants[next].name;
            compared.score = std::move(one.score);
            compared.timed = std::move(one.timed);
            compared.shown = std::move(one.shown);
            compared.path = TechniqueOnPath{one.stability, std::move(one.rmse), std::move(one.steps)};
            result.techniques.push_back(std::move(compared));
        }
        result.baseline_bytes = walked.baseline_bytes;
        std::vector<host::FrameTimes>& samples = result.baseline.samples;
        samples.insert(samples.end(), walked.baseline.samples.begin(), walked.baseline.samples.end());
    }
    result.pixels = result.techniques.front().score.pixels.counts;
    moveShot(shot, settings, settings.frames->first);
}

} // namespace gnomon::app
