// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "command_text.h"
#include "technique_json.h"

#include "scene/hash.h"

#include <algorithm>

namespace gnomon::app {
namespace {

/// In how many of its frames the mask was left as it was.
std::size_t keptMasks(const lab::Timed& technique)
{
    return static_cast<std::size_t>(std::ranges::count_if(technique.samples, &host::FrameTimes::mask_kept));
}

Json techniqueJson(const BenchedTechnique& technique)
{
    Json json{{"technique", describeTechnique(technique.settings)},
              {"choices", choicesJson(technique.settings.shadow.technique)},
              {"map", mapJson(technique.redrawn.atlas, technique.settings.shadow)}};
    addTimes(json, "", technique.redrawn.samples);
    json["frame_ratio"] = frameRatioJson(technique.redrawn);
    addTimes(json, "static_", technique.reused.samples);
    json["static_frame_ratio"] = frameRatioJson(technique.reused);
    json["static_mean_texels_rendered"] = numberJson(technique.reused.mean_texels_rendered);
    json["static_reuse"] = reuseJson(technique.reused.samples);
    if (technique.still) {
        addTimes(json, "still_", technique.still->samples);
        json["still_frame_ratio"] = frameRatioJson(*technique.still);
        json["still_masks_kept"] = keptMasks(*technique.still);
    }
    addMemory(json, technique.redrawn.added_memory);
    json["texel_density"] = densityJson(technique.density);
    json["fit_efficiency"] = fitEfficiencyJson(technique.density, technique.fit_efficiency);
    json["counters"] = countersJson(technique.redrawn.counters);
    json["passes"] = passesJson(technique.redrawn);
    json["cascade_pass"] = cascadePassJson(technique.redrawn);
    json["settings"] = settingsJson(technique.settings, kBench);
    json["settings"].erase("techniques"); // it is one of them
    return json;
}

} // namespace

Json benchHead(const BenchResult& result, const Shot& shot, const Settings& settings)
{
    const std::string scene_hash = scene::toString(scene::sceneHash(shot.scene));
    Json json{{"version", GNOMON_VERSION}, {"scene", settings.scene}, {"scene_hash", scene_hash},
              {"camera", shot.camera},     {"device", result.device}, {"driver", result.driver},
              {"eye", eyeJson(shot.eye)}};
    json["light"] = shot.lights.front().name;
    json["lights"] = Json::array();
    for (const host::ShadedLight& light : shot.lights) {
        json["lights"].push_back(lightJson(light));
    }
    if (!settings.path.empty()) {
        json["path"] = pathJson(settings);
    }
    json["settings"] = runJson(settings, scene_hash, kBench);
    return json;
}

Json benchJson(const BenchResult& result, const Shot& shot, const Settings& settings)
{
    Json json = benchHead(result, shot, settings);
    Json baseline;
    addTimes(baseline, "", result.baseline.samples);
    baseline["memory_bytes"] = result.baseline_bytes;
    baseline["passes"] = passesJson(result.baseline);
    json["baseline"] = baseline;
    json["frames_timed"] = result.techniques.front().redrawn.samples.size();
    json["not_measured"] = notMeasured(result.baseline.samples);
    json["results"] = Json::array();
    for (const BenchedTechnique& technique : result.techniques) {
        json["results"].push_back(techniqueJson(technique));
        json["results"].back()["command"] = commandText(settings, kBench, describeTechnique(technique.settings));
    }
    json["units"] = sharedUnitsJson();
    json["units"]["static_mean_texels_rendered"] = "texels per frame, maps that still hold kept";
    json["units"]["static_reuse"] = "maps, texels and casters per frame, maps that still hold kept";
    json["units"]["static_frame_ratio"] = "median frame with maps that still hold kept / median frame without shadows";
    json["units"]["still_frame_ratio"] =
        "median frame with maps and masks that still hold kept / median frame without shadows";
    json["units"]["still_masks_kept"] = "of the frames timed";
    return json;
}

} // namespace gnomon::app
