// SPDX-License-Identifier: Apache-2.0
#include "compare_steps.h"

#include "command_text.h"
#include "technique_json.h"

#include <cmath>

namespace gnomon::app {
namespace {

Json outcomeJson(const Outcome& outcome)
{
    Json json{{"kind", nameOf(outcome.kind)}};
    json["reason"] = outcome.reason.empty() ? Json(nullptr) : Json(outcome.reason);
    return json;
}

Json equalErrorJson(const EqualError& equal)
{
    const auto text = [](const std::string& value) {
        return value.empty() ? Json(nullptr) : Json(value);
    };
    return {{"technique", text(equal.pcf)},
            {"rmse", numberJson(equal.pcf_rmse)},
            {"frame_ms",
             {{"technique", numberJson(equal.technique_ms)},
              {"pcf", numberJson(equal.pcf_ms)},
              {"without_shadows", numberJson(equal.without_ms)}}},
            {"cheaper", {{"technique", text(equal.cheaper)}, {"rmse", numberJson(equal.cheaper_rmse)}}},
            {"tried", equal.tried},
            {"reason", text(equal.reason)}};
}

std::string_view nameOf(truth::Kind kind)
{
    return kind == truth::Kind::area ? "area" : "hard";
}

Json stabilityJson(const TechniqueOnPath& path, const lab::Score& score)
{
    // The truth's sun is where it is at every frame, so the error is that of a sun which a technique lets lag behind.
    return {{"shimmer", memberJson(path.stability, &lab::Stability::shimmer)},
            {"pop", memberJson(path.stability, &lab::Stability::pop)},
            {"lag", memberJson(score.error, &lab::ErrorNumbers::rmse)}};
}

/// Lists as long as the frames.
Json overFramesJson(const TechniqueOnPath& path)
{
    Json rmse = Json::array();
    for (const std::optional<double>& one : path.rmse) {
        rmse.push_back(numberJson(one));
    }
    Json change = Json::array({nullptr}); // the first frame has none before it
    for (const lab::StabilityMeter::Step& step : path.steps) {
        change.push_back(step.matched == 0 ? Json(nullptr) : numberJson(step.mean_abs));
    }
    return {{"rmse", rmse}, {"mean_abs_change", change}};
}

/// The frame at the end of the step that pops most; null where none pops.
Json popFrameJson(const PathResult& path, const TechniqueOnPath& technique)
{
    const bool popped = technique.stability && technique.stability->pop > 0.0;
    return popped ? Json(path.frames.first + technique.stability->pop_frame) : Json(nullptr);
}

/// Is it worth a column? Light all but grazes a few pixels of any round body.
bool showsGrazing(const lab::PixelCounts& pixels)
{
    return pixels.grazing * 50 > pixels.counted;
}

Json techniqueJson(const ComparedTechnique& technique, const std::optional<PathResult>& path)
{
    const lab::Score& score = technique.score;
    Json json{{"technique", technique.name},
              {"choices", choicesJson(technique.settings.shadow.technique)},
              {"map", mapJson(score.atlas, technique.settings.shadow)},
              {"error",
               errorJson(score.error, score.classification ? std::optional(score.classification->errors) : std::nullopt,
                         {{"ssim", numberJson(score.ssim)}, {"flip", numberJson(score.flip)}})}};
    if (showsGrazing(score.pixels.counts)) {
        json["grazing"] = {{"pixels", score.pixels.counts.grazing}, {"rmse", numberJson(score.grazing_rmse)}};
    }
    if (path && path->frames.first != path->frames.last) {
        json["stability"] = stabilityJson(*technique.path, score);
        json["pop_frame"] = popFrameJson(*path, *technique.path);
    }
    if (path) {
        json["over_frames"] = overFramesJson(*technique.path);
        json["mean_texels_rendered"] = numberJson(technique.timed.mean_texels_rendered);
    }
    addTimes(json, "", technique.timed.samples);
    json["frames_timed"] = technique.timed.samples.size();
    json["frame_ratio"] = frameRatioJson(technique.timed);
    if (technique.equal_error) {
        json["equal_error_ratio"] = numberJson(technique.equal_error->ratio);
        json["equal_error_shadow_ratio"] = numberJson(technique.equal_error->shadow_ratio);
        json["equal_error"] = equalErrorJson(*technique.equal_error);
    }
    addMemory(json, technique.timed.added_memory);
    json["texel_density"] = densityJson(score.density);
    json["fit_efficiency"] = fitEfficiencyJson(score.density, score.fit_efficiency);
    json["outcome"] = outcomeJson(score.outcome);
    json["pixels"] = pixelsJson(score.pixels.counts);
    json["counters"] = countersJson(technique.timed.counters);
    json["reuse"] = reuseJson(technique.timed.samples);
    json["passes"] = passesJson(technique.timed);
    json["cascade_pass"] = cascadePassJson(technique.timed);
    json["settings"] = settingsJson(technique.settings, kCompare);
    json["settings"].erase("techniques"); // it is one of them
    return json;
}

/// Adds the truth and the pixels at each value of a sweep, the same for all techniques, as lists as long as the values.
void addPlaces(Json& json, const SweepResult& sweep)
{
    json["truth"] = Json::array();
    json["pixels"] = Json::array();
    for (const SweepResult::Place& place : sweep.places) {
        json["truth"].push_back(truthJson(place.truth, place.standard_error));
        json["pixels"].push_back(pixelsJson(place.pixels));
    }
}

/// How to have each point of a sweep alone.
void addCommands(Json& json, const SweepPlan& plan, const Settings& settings)
{
    for (std::size_t line = 0; line < plan.lines.size(); ++line) {
        Json commands = Json::array();
        for (std::size_t value = 0; value < plan.values.size(); ++value) {
            commands.push_back(commandText(plan.remakes_shot ? settingsAt(plan, value, settings) : settings, kCompare,
                                           describeTechnique(plan.lines[line].points[value])));
        }
        json["results"][line]["commands"] = std::move(commands);
    }
}

Json unitsJson()
{
    Json units = sharedUnitsJson();
    units["error"] =
        "visibility, 0 to 1; edge, acne, detached, bleeding and terminator are mean squares that add up to rmse^2";
    units["equal_error_ratio"] = "median frame / median frame of the PCF that errs no more";
    units["equal_error_shadow_ratio"] = "the same of what the two frames take beyond the frame without shadows";
    units["standard_error"] = "visibility, root mean square over the counted pixels";
    units["truth.samples"] = "rays per pixel";
    units["reuse"] = "maps, texels and casters per frame";
    units["stability"] = "visibility: root mean square, largest mean of a frame, rmse";
    units["over_frames"] = "visibility; rmse, and mean change of the error since the frame before";
    units["texel_density.pixels"] = "pixels that see a surface: counted and in one of the light's maps, and all others";
    return units;
}

} // namespace

Json pixelsJson(const lab::PixelCounts& pixels)
{
    return {{"counted", pixels.counted},
            {"terminator", pixels.terminator},
            {"left_out", pixels.leftOut()},
            {"left_out_by_reason",
             {{"background", pixels.background},
              {"other_object", pixels.other_object},
              {"facing_away", pixels.facing_away},
              {"unlit", pixels.unlit},
              {"no_receiver", pixels.no_receiver},
              {"grazing", pixels.grazing}}}};
}

Json truthJson(const TruthFacts& truth, const std::optional<double>& standard_error)
{
    // A truth from the cache was traced by another run, whose time says nothing of this one.
    const bool timed = !truth.from_cache && truth.seconds > 0.0;
    return {{"kind", nameOf(tracedKind(truth))},
            {"requested", nameOf(truth.kind)},
            {"pixels", truth.pixels == truth::PixelTruth::area ? "area" : "centre"},
            {"samples", truth.samples},
            {"standard_error", numberJson(standard_error)},
            {"seed", truth.seed},
            {"rays", truth.rays},
            {"seconds", timed ? numberJson(truth.seconds) : Json(nullptr)},
            {"rays_per_second", timed && truth.rays != 0
                                    ? numberJson(std::round(static_cast<double>(truth.rays) / truth.seconds))
                                    : Json(nullptr)},
            {"from_cache", truth.from_cache}};
}

Json compareJson(const CompareResult& result, const Shot& shot, const Settings& settings)
{
    Json json{{"version", GNOMON_VERSION},
              {"scene", settings.scene},
              {"scene_hash", result.scene_hash},
              {"camera", shot.camera},
              {"light", result.light().name},
              {"device", result.device},
              {"driver", result.driver},
              {"size_px", {settings.size_px.x, settings.size_px.y}},
              {"eye", eyeJson(shot.eye)},
              {"light_source", lightJson(result.light())},
              {"truth", truthJson(result.judged.facts, result.standard_error)}};
    if (result.path) {
        json["path"] = pathJson(settings);
    }
    json["results"] = Json::array();
    for (const ComparedTechnique& technique : result.techniques) {
        json["results"].push_back(techniqueJson(technique, result.path));
        json["results"].back()["command"] = commandText(settings, kCompare, technique.name);
    }
    json["pixels"] = pixelsJson(result.pixels);
    if (result.sweep) {
        json["sweep"] = sweepJson(*result.sweep);
        addCommands(json["sweep"], result.sweep->plan, settings);
        if (result.sweep->plan.remakes_shot) {
            addPlaces(json["sweep"], *result.sweep);
        }
    } else {
        Json baseline;
        addTimes(baseline, "", result.baseline.samples);
        baseline["memory_bytes"] = result.baseline_bytes;
        baseline["passes"] = passesJson(result.baseline);
        json["baseline"] = baseline;
    }
    json["notes"] = compareNotes(result, json);
    if (!settings.report.empty()) {
        json["report_files"] = Json::array(); // until they are written
    }
    json["settings"] = runJson(settings, result.scene_hash, kCompare);
    json["units"] = unitsJson();
    return json;
}

} // namespace gnomon::app
