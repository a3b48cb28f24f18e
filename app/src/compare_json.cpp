// SPDX-License-Identifier: Apache-2.0
#include "compare_json.h"

#include "technique_json.h"

#include <cmath>

namespace gnomon::app {
namespace {

Json errorJson(const lab::Score& score)
{
    const auto number = [&](double lab::ErrorNumbers::*member) {
        return score.error ? numberJson((*score.error).*member) : Json(nullptr);
    };
    const auto share = [&](double lab::ClassErrors::*member) {
        return score.error && score.classification ? numberJson(score.classification->errors.*member) : Json(nullptr);
    };
    return {{"rmse", number(&lab::ErrorNumbers::rmse)},
            {"mae", number(&lab::ErrorNumbers::mae)},
            {"bias", number(&lab::ErrorNumbers::bias)},
            {"p99", number(&lab::ErrorNumbers::p99)},
            {"ssim", numberJson(score.ssim)},
            {"flip", numberJson(score.flip)},
            {"edge", share(&lab::ClassErrors::edge)},
            {"acne", share(&lab::ClassErrors::acne)},
            {"detached", share(&lab::ClassErrors::detached)},
            {"bleeding", share(&lab::ClassErrors::bleeding)}};
}

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
            {"frame_ms", {{"technique", numberJson(equal.technique_ms)}, {"pcf", numberJson(equal.pcf_ms)}}},
            {"tried", equal.tried},
            {"reason", text(equal.reason)}};
}

Json pixelsJson(const lab::PixelCounts& pixels)
{
    return {{"counted", pixels.counted},
            {"left_out", pixels.leftOut()},
            {"left_out_by_reason",
             {{"background", pixels.background},
              {"other_object", pixels.other_object},
              {"facing_away", pixels.facing_away},
              {"unlit", pixels.unlit},
              {"no_receiver", pixels.no_receiver}}}};
}

Json truthJson(const CompareResult& result, const Settings& settings)
{
    const truth::Visibility& visibility = result.truth.visibility;
    return {{"kind", visibility.kind == truth::Kind::area ? "area" : "hard"},
            {"samples", result.samples},
            {"standard_error", numberJson(result.standard_error)},
            {"seed", settings.seed},
            {"rays", visibility.rays},
            {"seconds", numberJson(visibility.seconds)},
            {"rays_per_second", visibility.seconds > 0.0
                                    ? numberJson(std::round(static_cast<double>(visibility.rays) / visibility.seconds))
                                    : Json(nullptr)},
            {"from_cache", result.from_cache}};
}

Json techniqueJson(const ComparedTechnique& technique, const CompareResult& result)
{
    const lab::Score& score = technique.score;
    Json json{{"technique", technique.name},
              {"choices", choicesJson(technique.settings.plan.technique)},
              {"map", mapJson(score.atlas, technique.settings.filter.format)},
              {"error", errorJson(score)}};
    addTimes(json, "", technique.timed.samples);
    const double ratio = lab::frameRatio(technique.timed, result.baseline);
    json["frame_ratio"] = ratio > 0.0 ? Json(std::round(ratio * 1e4) / 1e4) : Json(nullptr);
    if (technique.equal_error) {
        json["equal_error_ratio"] = numberJson(technique.equal_error->ratio);
        json["equal_error"] = equalErrorJson(*technique.equal_error);
    }
    addMemory(json, technique.timed.added_memory);
    json["texel_density"] = densityJson(score.density);
    json["fit_efficiency"] = score.density.counted == 0 ? Json(nullptr) : numberJson(score.fit_efficiency);
    json["outcome"] = outcomeJson(score.outcome);
    json["pixels"] = pixelsJson(score.pixels.counts);
    json["counters"] = countersJson(technique.timed.counters);
    json["passes_ms"] = passesJson(technique.timed.samples);
    json["settings"] = settingsJson(technique.settings, kCompare);
    return json;
}

/// Of keys that do not name theirs.
Json unitsJson()
{
    return {{"error", "visibility, 0 to 1; edge, acne, detached and bleeding are mean squares that add up to rmse^2"},
            {"frame_ratio", "median frame / median frame without shadows"},
            {"equal_error_ratio", "median frame / median frame of the PCF that errs no more"},
            {"texel_density", "shadow texels per screen pixel along the worse axis"},
            {"fit_efficiency", "texels read / texels rendered"},
            {"standard_error", "visibility, root mean square over the counted pixels"},
            {"eye.near_m", "metres; 0: a 20000th of the scene's diagonal"},
            {"eye.far_m", "metres; 0: behind everything"},
            {"map.texels", "texels of all layers"},
            {"pixels", "pixels"},
            {"truth.samples", "rays per pixel"}};
}

} // namespace

Json compareJson(const CompareResult& result, const Shot& shot, const Settings& settings)
{
    Json json{{"version", GNOMON_VERSION},
              {"scene", settings.scene},
              {"scene_hash", result.scene_hash},
              {"camera", shot.camera},
              {"light", result.light.name},
              {"device", result.device},
              {"driver", result.driver},
              {"size_px", {settings.size_px.x, settings.size_px.y}},
              {"eye", eyeJson(shot.eye)},
              {"light_source", lightJson(result.light)},
              {"truth", truthJson(result, settings)}};
    json["results"] = Json::array();
    for (const ComparedTechnique& technique : result.techniques) {
        json["results"].push_back(techniqueJson(technique, result));
    }
    json["pixels"] = pixelsJson(result.pixels);
    if (result.sweep) {
        json["sweep"] = sweepJson(*result.sweep);
    } else {
        Json baseline;
        addTimes(baseline, "", result.baseline.samples);
        baseline["memory_bytes"] = result.baseline_bytes;
        baseline["passes_ms"] = passesJson(result.baseline.samples);
        json["baseline"] = baseline;
    }
    json["notes"] = result.notes;
    json["settings"] = repeatJson(settings, kCompare);
    json["units"] = unitsJson();
    return json;
}

std::string jsonText(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::app
