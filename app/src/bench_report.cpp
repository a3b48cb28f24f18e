// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "command_text.h"
#include "compare_table.h"
#include "technique_json.h"

#include "lab/passes.h"
#include "scene/hash.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

std::string ratioCell(const lab::Timed& technique)
{
    const double ratio = lab::frameRatio(technique);
    return cell(ratio > 0.0 ? std::optional(ratio) : std::nullopt, 2);
}

std::string iqrCell(const std::vector<host::FrameTimes>& samples)
{
    const std::optional<lab::Spread> frame = spreadOfStage(samples, stages().back());
    return cell(frame && samples.size() > 1 ? std::optional(frame->iqr) : std::nullopt, 3);
}

/// The cost of blurring maps: a line for each technique that blurs.
std::string blurTable(const BenchResult& result)
{
    TextTable table{{"blur", "path", "Mtexels", "taps/texel", "MiB moved", "least", "ratio"}, {}};
    for (const BenchedTechnique& technique : result.techniques) {
        const vulkan::FilterCost& cost = technique.redrawn.counters.filter;
        if (cost.texels == 0) {
            continue;
        }
        constexpr double kMiB = 1024.0 * 1024.0;
        const auto texels = static_cast<double>(cost.texels);
        table.rows.push_back({describeTechnique(technique.settings), std::string(nameOf(cost.path)),
                              cell(texels / 1e6, 2), cell(static_cast<double>(cost.taps) / texels, 1),
                              cell(static_cast<double>(cost.bytes_moved) / kMiB, 1),
                              cell(static_cast<double>(cost.bytes_minimum) / kMiB, 1), cell(filterRatio(cost), 2)});
    }
    return table.rows.empty() ? std::string() : "\n" + fittedTableText(table);
}

/// How cascades were drawn: a line for each technique that has them.
std::string cascadeTable(const BenchResult& result)
{
    TextTable table{{"cascades", "drawn"}, {}};
    for (const BenchedTechnique& technique : result.techniques) {
        if (const auto pass = cascadePassOf(technique.redrawn)) {
            table.rows.push_back({describeTechnique(technique.settings), std::string(nameOf(*pass))});
        }
    }
    return table.rows.empty() ? std::string() : "\n" + fittedTableText(table);
}

/// The time of each pass of the one technique, beside the frame without shadows. With several techniques it is empty:
/// it would be long, and results have it.
std::string passTable(const BenchResult& result)
{
    if (result.techniques.size() != 1) {
        return {};
    }
    const lab::Timed& timed = result.techniques.front().redrawn;
    const std::vector<lab::PassWork> without = lab::passesOf(result.baseline.samples, {});
    const double frame_ms = frameMedian(timed.samples);
    std::optional<double> outside_ms = frame_ms;
    const auto partOf = [](const std::optional<lab::Spread>& ms, double lab::Spread::*part) {
        return ms ? std::optional(*ms.*part) : std::nullopt;
    };
    const auto shareOf = [frame_ms](const std::optional<double>& ms) {
        return ms && frame_ms > 0.0 ? std::optional(*ms / frame_ms) : std::nullopt;
    };
    TextTable table{{"pass", "ms", "iqr", "share", "without", "vertices", "fragments", "compute", "draws", "least MiB"},
                    {}};
    const auto count = [](const lab::PassWork& pass, std::uint64_t vulkan::PassRecord::*member) {
        return pass.sum.has_statistics ? fmt::format("{}", pass.sum.*member) : std::string(kNoNumber);
    };
    for (const lab::PassWork& pass : lab::passesOf(timed.samples, timed.least)) {
        const auto same = std::ranges::find(without, pass.name, &lab::PassWork::name);
        constexpr double kMiB = 1024.0 * 1024.0;
        const std::optional<double> median = partOf(pass.ms, &lab::Spread::median);
        outside_ms = outside_ms && median ? std::optional(*outside_ms - *median) : std::nullopt;
        table.rows.push_back(
            {pass.name, cell(median, 3),
             cell(timed.samples.size() > 1 ? partOf(pass.ms, &lab::Spread::iqr) : std::nullopt, 3),
             cell(shareOf(median), 3),
             cell(same != without.end() ? partOf(same->ms, &lab::Spread::median) : std::nullopt, 3),
             count(pass, &vulkan::PassRecord::vertex_invocations),
             count(pass, &vulkan::PassRecord::fragment_invocations),
             count(pass, &vulkan::PassRecord::compute_invocations), fmt::format("{}", pass.sum.draws),
             cell(pass.least ? std::optional(static_cast<double>(pass.least->bytes) / kMiB) : std::nullopt, 2)});
    }
    table.rows.push_back({"outside", cell(outside_ms, 3), std::string(kNoNumber), cell(shareOf(outside_ms), 3)});
    table.rows.back().resize(table.columns.size(), std::string(kNoNumber));
    return "\n" + fittedTableText(table);
}

/// The counters of vulkan::MapReuse for frames along a path.
std::string reuseTable(const BenchResult& result)
{
    TextTable table{{"maps that hold kept, per frame"}, {}};
    for (const ReuseCounter& counter : reuseCounters({})) {
        table.columns.emplace_back(counter.title);
    }
    for (const BenchedTechnique& technique : result.techniques) {
        std::vector<std::string>& row = table.rows.emplace_back();
        row.push_back(describeTechnique(technique.settings));
        for (const ReuseCounter& counter : reuseCounters(technique.reused.samples)) {
            row.push_back(cell(counter.mean, 2));
        }
    }
    return "\n" + fittedTableText(table);
}

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

std::string benchTable(const BenchResult& result, const Shot& shot, const Settings& settings)
{
    std::size_t width = 10;
    for (const BenchedTechnique& technique : result.techniques) {
        width = std::max(width, describeTechnique(technique.settings).size());
    }
    const std::string path =
        settings.path.empty() ? "" : fmt::format(" along {} from {}", settings.path, settings.frames->first);
    std::string text = fmt::format(
        "{}, camera {}, {}x{}, map {}, on {} ({})\nmedian milliseconds of {} frames{}; static: "
        "maps that still hold are kept, still: masks too\n\n{:<{}}",
        settings.scene, shot.camera, settings.size_px.x, settings.size_px.y, largestSide(settings.shadow),
        result.device, result.driver, result.techniques.front().redrawn.samples.size(), path, "technique", width);
    for (const Stage& stage : stages()) {
        text += fmt::format("{:>9}", stage.name);
    }
    text += fmt::format("{:>8}{:>7}{:>9}{:>7}{:>9}{:>7}{:>9}\n", "iqr", "ratio", "static", "ratio", "still", "ratio",
                        "MiB");
    text += fmt::format("{:<{}}{:>9}{:>9}{:>9}{:>9}{:>9.3f}{:>8}{:>7}\n", "no shadows", width, "", "", "", "",
                        frameMedian(result.baseline.samples), iqrCell(result.baseline.samples), "1.00");
    for (const BenchedTechnique& technique : result.techniques) {
        text += fmt::format("{:<{}}", describeTechnique(technique.settings), width);
        for (const Stage& stage : stages()) {
            const std::optional<lab::Spread> spread = spreadOfStage(technique.redrawn.samples, stage);
            text += fmt::format("{:>9}", cell(spread ? std::optional(spread->median) : std::nullopt, 3));
        }
        const std::optional<lab::Timed>& still = technique.still;
        text += fmt::format("{:>8}{:>7}{:>9.3f}{:>7}{:>9}{:>7}{:>9.2f}\n", iqrCell(technique.redrawn.samples),
                            ratioCell(technique.redrawn), frameMedian(technique.reused.samples),
                            ratioCell(technique.reused),
                            cell(still ? std::optional(frameMedian(still->samples)) : std::nullopt, 3),
                            still ? ratioCell(*still) : std::string(kNoNumber),
                            static_cast<double>(totalBytes(technique.redrawn.added_memory)) / (1024.0 * 1024.0));
    }
    for (const std::string& missing : notMeasured(result.techniques.front().redrawn.samples)) {
        text += missing + "\n";
    }
    return text + passTable(result) + blurTable(result) + cascadeTable(result) +
           (settings.path.empty() ? "" : reuseTable(result));
}

} // namespace gnomon::app
