// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "technique_json.h"

#include "scene/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

double ratio(const lab::Timed& technique, const lab::Timed& baseline)
{
    return std::round(lab::frameRatio(technique, baseline) * 1e4) / 1e4;
}

Json techniqueJson(const BenchedTechnique& technique, const BenchResult& result)
{
    Json json{{"technique", describeTechnique(technique.settings)},
              {"choices", choicesJson(technique.settings.plan.technique)},
              {"map", mapJson(technique.redrawn.atlas, technique.settings.filter.format)}};
    addTimes(json, "", technique.redrawn.samples);
    json["frame_ratio"] = ratio(technique.redrawn, result.baseline);
    addTimes(json, "static_", technique.reused.samples);
    json["static_frame_ratio"] = ratio(technique.reused, result.baseline);
    addMemory(json, technique.redrawn.added_memory);
    json["texel_density"] = densityJson(technique.density);
    json["fit_efficiency"] = std::round(technique.fit_efficiency * 1e6) / 1e6;
    json["counters"] = countersJson(technique.redrawn.counters);
    json["passes_ms"] = passesJson(technique.redrawn.samples);
    json["settings"] = settingsJson(technique.settings, kBench);
    return json;
}

} // namespace

Json benchJson(const BenchResult& result, const Shot& shot, const Settings& settings)
{
    Json json{{"version", GNOMON_VERSION},
              {"scene", settings.scene},
              {"scene_hash", scene::toString(scene::sceneHash(shot.scene))},
              {"camera", shot.camera},
              {"device", result.device},
              {"driver", result.driver},
              {"eye", eyeJson(shot.eye)}};
    json["light"] = shot.lights.front().name;
    json["lights"] = Json::array();
    for (const host::ShadedLight& light : shot.lights) {
        json["lights"].push_back(lightJson(light));
    }
    json["settings"] = repeatJson(settings, kBench);
    Json baseline;
    addTimes(baseline, "", result.baseline.samples);
    baseline["memory_bytes"] = result.baseline_bytes;
    baseline["passes_ms"] = passesJson(result.baseline.samples);
    json["baseline"] = baseline;
    json["results"] = Json::array();
    for (const BenchedTechnique& technique : result.techniques) {
        json["results"].push_back(techniqueJson(technique, result));
    }
    return json;
}

std::string benchTable(const BenchResult& result, const Shot& shot, const Settings& settings)
{
    std::size_t width = 10;
    for (const BenchedTechnique& technique : result.techniques) {
        width = std::max(width, describeTechnique(technique.settings).size());
    }
    std::string text =
        fmt::format("{}, camera {}, {}x{}, map {}, on {} ({})\nmedian milliseconds of {} frames; static: "
                    "maps that still hold are kept\n\n{:<{}}",
                    settings.scene, shot.camera, settings.size_px.x, settings.size_px.y, settings.plan.map_size,
                    result.device, result.driver, settings.repetitions, "technique", width);
    for (const Stage& stage : stages()) {
        text += fmt::format("{:>9}", stage.name);
    }
    text += fmt::format("{:>8}{:>7}{:>9}{:>7}{:>9}\n", "iqr", "ratio", "static", "ratio", "MiB");
    const lab::Spread without = spreadOfStage(result.baseline.samples, stages().back());
    text += fmt::format("{:<{}}{:>9}{:>9}{:>9}{:>9}{:>9.3f}{:>8.3f}{:>7}\n", "no shadows", width, "", "", "", "",
                        without.median, without.iqr, "1.00");
    for (const BenchedTechnique& technique : result.techniques) {
        text += fmt::format("{:<{}}", describeTechnique(technique.settings), width);
        for (const Stage& stage : stages()) {
            text += fmt::format("{:>9.3f}", spreadOfStage(technique.redrawn.samples, stage).median);
        }
        text += fmt::format("{:>8.3f}{:>7.2f}{:>9.3f}{:>7.2f}{:>9.2f}\n",
                            spreadOfStage(technique.redrawn.samples, stages().back()).iqr,
                            ratio(technique.redrawn, result.baseline), frameMedian(technique.reused.samples),
                            ratio(technique.reused, result.baseline),
                            static_cast<double>(totalBytes(technique.redrawn.added_memory)) / (1024.0 * 1024.0));
    }
    return text;
}

} // namespace gnomon::app
