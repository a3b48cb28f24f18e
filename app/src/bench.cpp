// SPDX-License-Identifier: Apache-2.0
// `gnomon bench`: times of techniques on one frame, interleaved in one process, against the frame without shadows.
#include "app/shot.h"
#include "app/visual.h"
#include "bench_against.h"
#include "bench_report.h"
#include "compare_folder.h"
#include "contestants.h"
#include "progress.h"
#include "report_pages.h"
#include "shot_parts.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"
#include "lab/texel_density.h"
#include "lab/timing.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

namespace gnomon::app {
namespace {

lab::Subject subjectOf(const Shot& shot)
{
    return {.scene = &shot.scene, .state = &shot.state, .eye = shot.eye, .lights = shot.lights, .light = 0};
}

/// Before anything is drawn, and by the technique's name.
void requireForward(const lab::Contestant& contestant)
{
    const std::string_view refusal = contestant.options.shading == host::Shading::forward
                                         ? host::refusalOfForward(contestant.options)
                                         : std::string_view();
    if (!refusal.empty()) {
        throw Error(fmt::format("shading {} forward", contestant.name), std::string(refusal),
                    "leave it out, or leave --shading out");
    }
}

/// Whether a technique's frames keep maps and masks of earlier frames.
struct Kept {
    bool maps = false;
    bool masks = false;
};

/// Each technique's turns: all is drawn anew; maps are kept while they hold; where nothing moves, masks are kept too.
std::span<const Kept> turnsOf(const Settings& settings)
{
    static constexpr std::array kTurns{Kept{false, false}, Kept{true, false}, Kept{true, true}};
    return std::span(kTurns).first(settings.path.empty() ? 3 : 2);
}

std::vector<lab::Contestant> contestantsOf(const std::vector<Settings>& techniques, std::span<const Kept> turns)
{
    std::vector<lab::Contestant> contestants;
    for (const Settings& technique : techniques) {
        for (const Kept& kept : turns) {
            lab::Contestant contestant{describeTechnique(technique), renderOptions(technique)};
            requireForward(contestant);
            contestant.options.reuse_maps = kept.maps;
            contestant.options.reuse_masks = kept.masks;
            contestant.options.keeps_light = false; // as of a frame that is shown
            contestants.push_back(std::move(contestant));
        }
    }
    return contestants;
}

/// Measures the texel density and fit of the last frame's maps in the picture, which is the same for every technique.
void measureFit(const host::SceneOnGpu& scene, const Shot& shot, const Settings& settings, BenchResult& result)
{
    host::RenderOptions options = renderOptions(settings);
    options.shadows = false;
    options.shading = host::Shading::deferred; // for its geometry
    host::FrameRenderer renderer(scene, options);
    renderer.draw(shot.state, shot.eye, shot.lights);
    const host::Picture picture = renderer.read({.colour = false, .linear = false, .masks = false, .geometry = true});
    const Camera camera = host::cameraOf(shot.eye, settings.size_px.x, settings.size_px.y, shot.state.bounds_ws);
    const lab::Counted counted = lab::facingPixels(picture, camera, shot.lights.front().caster);
    for (BenchedTechnique& technique : result.techniques) {
        const Plan& plan = technique.redrawn.plan;
        const double reach_texels = reachTexels(technique.settings.shadow);
        technique.density = lab::texelDensity(picture, counted, camera, plan, 0, reach_texels);
        technique.fit_efficiency = lab::fitEfficiency(picture, counted, camera, plan, 0, reach_texels);
    }
}

/// Along a path every frame is drawn once; the first one warms up unless it is the only one.
lab::TimingOptions timingOptions(const Settings& settings)
{
    lab::TimingOptions options{.repetitions = settings.repetitions, .warmup = settings.warmup, .reuse_maps = true};
    if (!settings.path.empty()) {
        const std::uint32_t frames = settings.frames->last - settings.frames->first + 1;
        options.warmup = frames > 1 ? 1 : 0;
        options.repetitions = frames - options.warmup;
    }
    return options;
}

void measure(host::Gpu& gpu, Shot& shot, const Settings& settings, const std::vector<Settings>& techniques,
             BenchResult& result)
{
    const lab::TimingOptions options = timingOptions(settings);
    const host::SceneOnGpu scene(gpu, shot.scene, shot.state);
    lab::Subject subject = subjectOf(shot);
    const std::span<const Kept> turns = turnsOf(settings);
    const std::vector<lab::Contestant> contestants = contestantsOf(techniques, turns);
    Progress progress("timing", lab::timingSteps(subject, contestants, options));
    const lab::SubjectAt subject_at = [&](std::uint32_t round) -> const lab::Subject& {
        if (!settings.path.empty()) {
            moveShot(shot, settings, settings.frames->first + round);
            subject = subjectOf(shot);
        }
        return subject;
    };
    lab::TimingResult timing = lab::timeInTurn(scene, subject_at, contestants, options, [&] {
        requireSilence(gpu);
        progress.step();
    });
    result.baseline = std::move(timing.baseline);
    result.baseline_bytes = timing.baseline_bytes;
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        BenchedTechnique benched;
        benched.settings = techniques[i];
        const std::size_t first = i * turns.size();
        benched.redrawn = std::move(timing.techniques[first]);
        benched.reused = std::move(timing.techniques[first + 1]);
        if (turns.size() > 2) {
            benched.still = std::move(timing.techniques[first + 2]);
        }
        result.techniques.push_back(std::move(benched));
    }
    measureFit(scene, shot, settings, result);
    if (!settings.path.empty()) {
        moveShot(shot, settings, settings.frames->first); // whose camera and lights the result tells
    }
}

/// Lights without a shadow cost nothing, and their technique looks cheap: said once for each technique and reason.
void noteOutcomes(const BenchedTechnique& technique)
{
    const std::vector<LightPlan>& lights = technique.redrawn.plan.lights;
    std::vector<std::string_view> said;
    for (const LightPlan& light : lights) {
        const Outcome& outcome = light.outcome;
        const bool surprises = outcome.kind == OutcomeKind::refused || outcome.kind == OutcomeKind::degenerate ||
                               outcome.kind == OutcomeKind::atlas_full;
        if (!surprises || std::ranges::find(said, outcome.reason) != said.end()) {
            continue;
        }
        said.push_back(outcome.reason);
        const auto count = std::ranges::count_if(
            lights, [&](const LightPlan& other) { return other.outcome.reason == outcome.reason; });
        notice(fmt::format("{}: {} of {} lights without a shadow: {}: {}", describeTechnique(technique.settings), count,
                           lights.size(), nameOf(outcome.kind), outcome.reason));
    }
}

/// A bench and its results.
struct BenchRun {
    Shot shot;
    BenchResult result;
    std::optional<BenchFigures> earlier;
};

/// Reads the earlier run, and requires that it has the same picture, before minutes are spent on the bench.
std::optional<BenchFigures> earlierRun(const Settings& settings, const BenchRun& run,
                                       const std::vector<Settings>& techniques)
{
    if (settings.against.empty()) {
        return std::nullopt;
    }
    BenchFigures earlier = readBenchFigures(settings.against);
    std::vector<std::string> names;
    names.reserve(techniques.size());
    for (const Settings& technique : techniques) {
        names.push_back(describeTechnique(technique));
    }
    requireComparable(earlier, benchHead(run.result, run.shot, settings), names);
    const std::string device = run.result.device + ", " + run.result.driver;
    if (earlier.device != device) {
        notice(fmt::format("{} was measured on {}; this is {}, which may count otherwise", settings.against,
                           earlier.device, device));
    }
    return earlier;
}

BenchRun runTimes(const Settings& settings)
{
    const std::vector<Settings> techniques = contestants(settings);
    BenchRun run{makeShot(settings), {}, {}};
    const auto gpu = openGpu(settings);
    std::for_each(run.shot.notices.begin(), run.shot.notices.end(), notice);
    run.result.device = gpu->properties().deviceName;
    run.result.driver = gpu->driver();
    run.earlier = earlierRun(settings, run, techniques);
    measure(*gpu, run.shot, settings, techniques, run.result);
    requireSilence(*gpu);
    for (const BenchedTechnique& technique : run.result.techniques) {
        noteOutcomes(technique);
        if (const std::optional<std::string> waits = waitNote(technique.reused.waits)) {
            notice(fmt::format("{}: {}", describeTechnique(technique.settings), *waits));
        }
    }
    return run;
}

/// `json` gains "report_files".
void writeReport(ReportFolder& folder, Json& json)
{
    json["report_files"] = {kReportPage, kReportResult};
    const std::string text = jsonText(json);
    folder.write(kReportResult, text);
    folder.write(kReportPage, benchPage(Json::parse(text))); // the text is all UTF-8
    folder.keep();
}

} // namespace

Json findByTiming(const Settings& settings)
{
    const BenchRun run = runTimes(settings);
    return benchJson(run.result, run.shot, settings);
}

int runBench(const Settings& settings)
{
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    std::unique_ptr<ReportFolder> folder;
    if (!settings.report.empty()) {
        folder = std::make_unique<ReportFolder>(settings.report, std::vector<std::string>{kReportPage, kReportResult});
    }
    const BenchRun run = runTimes(settings);
    Json json = benchJson(run.result, run.shot, settings);
    if (run.earlier) {
        json["against"] = againstJson(*run.earlier, parseBenchFigures(jsonText(json), "this run"));
    }
    if (folder) {
        writeReport(*folder, json);
    }
    if (settings.json.empty()) {
        writeStdout(benchText(json, largestSide(settings.shadow)) +
                    (run.earlier ? againstText(json.at("against")) : std::string()));
    } else {
        writeResult(settings.json, jsonText(json));
    }
    if (run.earlier) {
        requireNoGrowth(json.at("against"));
    }
    return 0;
}

} // namespace gnomon::app
