// SPDX-License-Identifier: Apache-2.0
// `gnomon compare`: techniques on one frame of a scene against ray-traced truth.
#include "app/shot.h"
#include "app/visual.h"
#include "compare_folder.h"
#include "compare_scenes.h"
#include "compare_steps.h"
#include "compare_text.h"
#include "contestants.h"
#include "interrupt.h"
#include "progress.h"
#include "report_pictures.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"
#include "scene/hash.h"

#include <gnomon/choice_rules.h>
#include <gnomon/choices.h>
#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace gnomon::app {
namespace {

/// A light that every technique refuses leaves nothing to compare.
void requireCaster(const host::ShadedLight& light, const std::vector<Settings>& techniques)
{
    std::optional<std::string_view> why;
    for (const Settings& technique : techniques) {
        why = refusal(light.caster.type, technique.shadow);
        if (!why) {
            return;
        }
    }
    throw Error("comparing shadows of light " + light.name, std::string(why.value_or("there is no technique")),
                "choose another with --light");
}

/// A path that moves nothing but the sun is about the sun.
void requireJudgedSun(const Shot& shot, const Settings& settings)
{
    const bool sun_alone = shot.path && shot.path->movesSun() && !shot.path->movesCamera();
    const std::size_t light = lightIndex(shot, settings);
    if (sun_alone && light != shot.path->sun) {
        throw UsageError(fmt::format("--path {} moves light {} and not {}, which --light asks for", settings.path,
                                     shot.lights[shot.path->sun].name, shot.lights[light].name));
    }
}

void requireMapFits(const host::Gpu& gpu, const Settings& technique)
{
    const VkPhysicalDeviceLimits& limits = gpu.properties().limits;
    const std::uint32_t max_side =
        std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    if (largestSide(technique.shadow) > max_side) {
        throw Error("drawing " + describeTechnique(technique),
                    fmt::format("{} draws maps of at most {} texels on a side", gpu.properties().deviceName, max_side));
    }
}

void requireMapsFit(const host::Gpu& gpu, const std::vector<Settings>& techniques,
                    const std::optional<SweepPlan>& sweep)
{
    if (!sweep) {
        std::for_each(techniques.begin(), techniques.end(), [&](const Settings& one) { requireMapFits(gpu, one); });
        return;
    }
    for (const SweepPlan::Line& line : sweep->lines) {
        std::for_each(line.points.begin(), line.points.end(), [&](const Settings& one) { requireMapFits(gpu, one); });
    }
}

/// One run: what it is about, and what is done between two frames.
class Comparison {
public:
    Comparison(const Settings& settings, Shot& shot, host::Gpu& gpu)
        : settings_(settings), shot_(shot), gpu_(gpu), scene_(gpu, shot.scene, shot.state)
    {
        result_.device = gpu.properties().deviceName;
        result_.driver = gpu.driver();
        result_.scene_hash = scene::toString(scene::sceneHash(shot.scene));
    }

    void trace();
    void scoreAll(const std::vector<Settings>& techniques);
    void walk(const std::vector<Settings>& techniques);
    void timeAll();
    void matchAll();
    void sweep(const SweepPlan& plan);
    [[nodiscard]] const CompareResult& result() const { return result_; }

private:
    /// Called after every frame drawn.
    void step(Progress& progress) const
    {
        requireSilence(gpu_);
        progress.step();
    }
    void putBestFirst();

    const Settings& settings_;
    Shot& shot_;
    host::Gpu& gpu_;
    host::SceneOnGpu scene_;
    CompareResult result_;
};

void Comparison::trace()
{
    result_.judged = judge(shot_, settings_);
    if (!settings_.report.empty()) {
        result_.shades.push_back(drawShades(scene_, result_.judged.subject, settings_));
    }
}

/// Pictures of every pixel are kept for a report only: of many techniques they would fill the memory.
void Comparison::scoreAll(const std::vector<Settings>& techniques)
{
    Progress progress("comparing", techniques.size());
    for (const Settings& technique : techniques) {
        ComparedTechnique compared;
        compared.settings = technique;
        compared.name = describeTechnique(technique);
        compared.score = lab::scoreTechnique(scene_, result_.judged.subject, result_.judged.truth,
                                             renderOptions(technique), true, settings_.converge);
        if (result_.techniques.empty()) {
            result_.pixels = compared.score.pixels.counts;
            result_.standard_error = lab::truthNoise(result_.judged.truth.visibility, compared.score.pixels.counted);
        }
        lab::ShownFrame shown = lab::shownOf(compared.score);
        if (settings_.report.empty()) {
            compared.score.density.map = {};
        } else {
            compared.shown.push_back(std::move(shown));
        }
        result_.techniques.push_back(std::move(compared));
        step(progress);
    }
    putBestFirst();
}

/// Along --path.
void Comparison::walk(const std::vector<Settings>& techniques)
{
    Progress progress("comparing", pathSteps(settings_, techniques));
    comparePath(scene_, shot_, settings_, techniques, result_, [&] { step(progress); });
    putBestFirst();
}

void Comparison::putBestFirst()
{
    const auto rmse = [](const ComparedTechnique& technique) {
        const bool known = technique.score.error && std::isfinite(technique.score.error->rmse);
        return known ? technique.score.error->rmse : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(result_.techniques.begin(), result_.techniques.end(),
                     [&](const ComparedTechnique& a, const ComparedTechnique& b) { return rmse(a) < rmse(b); });
}

void Comparison::timeAll()
{
    std::vector<lab::Contestant> contestants;
    for (const ComparedTechnique& technique : result_.techniques) {
        contestants.push_back({technique.name, renderOptions(technique.settings)});
    }
    const lab::TimingOptions options{
        .repetitions = settings_.repetitions, .warmup = settings_.warmup, .reuse_maps = false};
    const lab::Subject& subject = result_.judged.subject;
    Progress progress("timing", lab::timingSteps(subject, contestants, options));
    lab::TimingResult timed = lab::timeInTurn(scene_, subject, contestants, options, [&] { step(progress); });
    result_.baseline = std::move(timed.baseline);
    result_.baseline_bytes = timed.baseline_bytes;
    for (std::size_t i = 0; i < result_.techniques.size(); ++i) {
        result_.techniques[i].timed = std::move(timed.techniques[i]);
    }
}

void Comparison::matchAll()
{
    // As many steps as there are at most: every PCF drawn once, every technique timed beside one.
    const std::uint64_t frames = 3 * (std::uint64_t{settings_.repetitions} + settings_.warmup);
    const std::size_t rungs = pcfLadder(settings_, kEqualErrorMaxMap).size();
    Progress progress("matching", rungs + frames * result_.techniques.size());
    const std::function<void()> after = [&] {
        step(progress);
    };
    EqualErrorSearch search(scene_, result_.judged.subject, result_.judged.truth, settings_, after);
    for (ComparedTechnique& technique : result_.techniques) {
        const auto& error = technique.score.error;
        technique.equal_error = search.match(technique.settings, error ? std::optional(error->rmse) : std::nullopt);
    }
}

void Comparison::sweep(const SweepPlan& plan)
{
    Progress progress("sweeping", plan.lines.size() * plan.values.size());
    std::unique_ptr<const JudgedShot> other; // the shot of the value that is swept over now, after the first
    const auto judged_at = [&](std::size_t value) -> const Judged& {
        if (value == 0 || !plan.remakes_shot) {
            return result_.judged;
        }
        other.reset(); // two may not fit in memory
        other = judgeShot(settingsAt(plan, value, settings_));
        return other->judged;
    };
    result_.sweep = runSweep(scene_, plan, judged_at, [&] { step(progress); });
    result_.pixels = result_.sweep->places.front().pixels;
    result_.standard_error = result_.sweep->places.front().standard_error;
}

/// The result; its notes are told and its report is written.
Json tell(const CompareResult& result, const Shot& shot, const Settings& settings, ReportFolder* folder)
{
    Json json = compareJson(result, shot, settings);
    for (const Json& note : json.at("notes")) {
        notice(note.get_ref<const std::string&>());
    }
    if (folder != nullptr) {
        Progress progress("drawing the report", result.techniques.size());
        writeReport(*folder, result, json, [&] { progress.step(); });
    }
    return json;
}

/// The settings of the shot that is made first.
Settings firstOf(const std::optional<SweepPlan>& sweep, const Settings& settings)
{
    return sweep && sweep->remakes_shot ? settingsAt(*sweep, 0, settings) : settings;
}

} // namespace

Json findByComparing(const Settings& settings)
{
    const std::vector<Settings> techniques = contestants(settings);
    std::optional<SweepPlan> sweep;
    if (settings.sweep) {
        sweep = planSweep(*settings.sweep, techniques);
    }
    std::unique_ptr<ReportFolder> folder;
    if (!settings.report.empty()) {
        folder = std::make_unique<ReportFolder>(
            settings.report, settings.path.empty() ? reportFiles(sweep ? 0 : techniques.size())
                                                   : pathReportFiles(techniques.size(), *settings.frames));
    }
    Shot shot = makeShot(firstOf(sweep, settings));
    const host::ShadedLight light = shot.lights[lightIndex(shot, settings)];
    requireJudgedSun(shot, settings);
    noteSizesWithoutEffect(shot, firstOf(sweep, settings), {&light, 1});
    requireCaster(light, techniques);
    const auto gpu = openGpu(settings);
    requireMapsFit(*gpu, techniques, sweep);
    const Settings first = firstOf(sweep, settings);
    std::for_each(shot.notices.begin(), shot.notices.end(), notice);
    Comparison comparison(first, shot, *gpu);
    if (!settings.path.empty()) {
        comparison.walk(techniques);
    } else if (sweep) {
        comparison.trace();
        comparison.sweep(*sweep);
    } else {
        comparison.trace();
        comparison.scoreAll(techniques);
        comparison.timeAll();
        if (settings.equal_error) {
            comparison.matchAll();
        }
    }
    requireSilence(*gpu);
    requireNotInterrupted();
    return tell(comparison.result(), shot, settings, folder.get());
}

int runCompare(const Settings& settings)
{
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    const bool is_one = settings.scenes.empty();
    const Json json = is_one ? findByComparing(settings) : compareScenes(settings);
    if (settings.json.empty()) {
        writeStdout(is_one ? compareText(json) : scenesText(json));
    } else {
        writeResult(settings.json, jsonText(json));
    }
    return 0;
}

} // namespace gnomon::app
