// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "scene_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::app {
namespace {

struct Stage {
    std::string_view name;
    double lab::StageTimes::*member;
};
constexpr std::array kStages{Stage{"plan", &lab::StageTimes::plan}, Stage{"maps", &lab::StageTimes::maps},
                             Stage{"filter", &lab::StageTimes::filter}, Stage{"mask", &lab::StageTimes::mask},
                             Stage{"frame", &lab::StageTimes::frame}};

lab::Spread spreadOfStage(const std::vector<host::FrameTimes>& samples, const Stage& stage)
{
    std::vector<double> values;
    for (const host::FrameTimes& sample : samples) {
        values.push_back(lab::stagesOf(sample).*stage.member);
    }
    return lab::spreadOf(std::move(values));
}

/// Microseconds are all that a clock gives; more digits would only look exact.
double rounded(double milliseconds)
{
    return std::round(milliseconds * 1e4) / 1e4;
}

void addTimes(Json& json, const std::string& prefix, const std::vector<host::FrameTimes>& samples)
{
    for (const Stage& stage : kStages) {
        const lab::Spread spread = spreadOfStage(samples, stage);
        json[prefix + "time_ms"][std::string(stage.name)] = rounded(spread.median);
        json[prefix + "iqr_ms"][std::string(stage.name)] = rounded(spread.iqr);
    }
}

/// Medians of every pass of the host and the library, for whoever wants to know where the rest went.
Json passesJson(const std::vector<host::FrameTimes>& samples)
{
    Json passes = Json::object();
    if (samples.empty()) {
        return passes;
    }
    for (std::size_t i = 0; i < samples.front().passes.size(); ++i) {
        std::vector<double> values;
        for (const host::FrameTimes& sample : samples) {
            if (i < sample.passes.size()) {
                values.push_back(sample.passes[i].milliseconds);
            }
        }
        passes[samples.front().passes[i].name] = rounded(lab::spreadOf(std::move(values)).median);
    }
    return passes;
}

double frameMedian(const std::vector<host::FrameTimes>& samples)
{
    return spreadOfStage(samples, kStages.back()).median;
}

double ratio(const lab::Timed& technique, const lab::Timed& baseline)
{
    return std::round(lab::frameRatio(technique, baseline) * 1e4) / 1e4;
}

std::uint64_t memoryBytes(const BenchedTechnique& technique)
{
    std::uint64_t bytes = 0;
    for (const auto& [purpose, count] : technique.redrawn.added_memory) {
        bytes += count;
    }
    return bytes;
}

std::uint32_t texelBytes(MapFormat format)
{
    switch (format) {
    case MapFormat::d16:
        return 2;
    case MapFormat::d32f:
    case MapFormat::r32f:
    case MapFormat::rg16:
    case MapFormat::rg16f:
        return 4;
    case MapFormat::rg32f:
    case MapFormat::rgba16:
    case MapFormat::rgba16f:
        return 8;
    case MapFormat::rgba32f:
        return 16;
    }
    return 0;
}

Json countersJson(const lab::Counters& counters)
{
    return {{"texels_rendered", counters.texels_rendered},
            {"texels_filtered", 0}, // hard and pcf filter nothing ahead of the mask
            {"vertex_invocations", counters.vertex_invocations},
            {"primitives", counters.primitives},
            {"fragment_invocations", counters.fragment_invocations},
            {"compute_invocations", counters.compute_invocations},
            {"draws", counters.draws},
            {"passes", counters.passes}};
}

Json techniqueJson(const BenchedTechnique& technique, const BenchResult& result)
{
    const AtlasSize& atlas = technique.redrawn.atlas;
    const std::uint64_t texels = std::uint64_t{atlas.width} * atlas.height * atlas.layers;
    const MapFormat format = technique.settings.filter.format;
    Json json{{"technique", describeTechnique(technique.settings)},
              {"choices", choicesJson(technique.settings.plan.technique)},
              {"map", {{"texels", texels}, {"bytes", texels * texelBytes(format)}, {"format", nameOf(format)}}}};
    addTimes(json, "", technique.redrawn.samples);
    json["frame_ratio"] = ratio(technique.redrawn, result.baseline);
    addTimes(json, "static_", technique.reused.samples);
    json["static_frame_ratio"] = ratio(technique.reused, result.baseline);
    json["memory_bytes"] = memoryBytes(technique);
    for (const auto& [purpose, bytes] : technique.redrawn.added_memory) {
        json["memory_by_purpose_bytes"][purpose] = bytes;
    }
    json["texel_density"] = {
        {"p01", technique.density.p01},
        {"p50", technique.density.p50},
        {"p99", technique.density.p99},
        {"pixels", {{"counted", technique.density.counted}, {"left_out", technique.density.left_out}}}};
    json["fit_efficiency"] = std::round(technique.fit_efficiency * 1e6) / 1e6;
    json["counters"] = countersJson(technique.redrawn.counters);
    json["passes_ms"] = passesJson(technique.redrawn.samples);
    json["settings"] = settingsJson(technique.settings, kBench);
    return json;
}

} // namespace

Json benchJson(const BenchResult& result, const Shot& shot, const Settings& settings)
{
    Json json{{"version", GNOMON_VERSION}, {"scene", settings.scene}, {"scene_hash", sceneHash(shot.scene)},
              {"camera", shot.camera},     {"device", result.device}, {"driver", result.driver}};
    json["eye"] = {{"position_ws", {shot.eye.position_ws.x, shot.eye.position_ws.y, shot.eye.position_ws.z}},
                   {"target_ws", {shot.eye.target_ws.x, shot.eye.target_ws.y, shot.eye.target_ws.z}},
                   {"up_ws", {shot.eye.up_ws.x, shot.eye.up_ws.y, shot.eye.up_ws.z}},
                   {"fov_y_rad", shot.eye.fov_y_rad}};
    json["light"] = shot.lights.front().name;
    json["lights"] = Json::array();
    for (const host::ShadedLight& light : shot.lights) {
        json["lights"].push_back({{"name", light.name}, {"type", nameOf(light.caster.type)}});
    }
    json["settings"] = settingsJson(settings, kBench);
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
    for (const Stage& stage : kStages) {
        text += fmt::format("{:>9}", stage.name);
    }
    text += fmt::format("{:>8}{:>7}{:>9}{:>7}{:>9}\n", "iqr", "ratio", "static", "ratio", "MiB");
    const lab::Spread without = spreadOfStage(result.baseline.samples, kStages.back());
    text += fmt::format("{:<{}}{:>9}{:>9}{:>9}{:>9}{:>9.3f}{:>8.3f}{:>7}\n", "no shadows", width, "", "", "", "",
                        without.median, without.iqr, "1.00");
    for (const BenchedTechnique& technique : result.techniques) {
        text += fmt::format("{:<{}}", describeTechnique(technique.settings), width);
        for (const Stage& stage : kStages) {
            text += fmt::format("{:>9.3f}", spreadOfStage(technique.redrawn.samples, stage).median);
        }
        text += fmt::format(
            "{:>8.3f}{:>7.2f}{:>9.3f}{:>7.2f}{:>9.2f}\n", spreadOfStage(technique.redrawn.samples, kStages.back()).iqr,
            ratio(technique.redrawn, result.baseline), frameMedian(technique.reused.samples),
            ratio(technique.reused, result.baseline), static_cast<double>(memoryBytes(technique)) / (1024.0 * 1024.0));
    }
    return text;
}

} // namespace gnomon::app
