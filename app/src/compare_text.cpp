// SPDX-License-Identifier: Apache-2.0
#include "compare_text.h"

#include "technique_json.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>

namespace gnomon::app {
namespace {

std::vector<std::string> namesOf(const CompareResult& result)
{
    std::vector<std::string> names;
    for (const ComparedTechnique& technique : result.techniques) {
        names.push_back(technique.name);
    }
    return names;
}

bool hasEqualError(const CompareResult& result)
{
    return std::any_of(result.techniques.begin(), result.techniques.end(),
                       [](const ComparedTechnique& technique) { return technique.equal_error.has_value(); });
}

/// The match of every technique, a line each.
std::string equalErrorText(const CompareResult& result)
{
    std::string text = "\nPCF of equal error, timed in turn with each technique:\n";
    for (const ComparedTechnique& technique : result.techniques) {
        if (!technique.equal_error) {
            continue;
        }
        const EqualError& equal = *technique.equal_error;
        text += fmt::format(
            "  {}: {}\n", technique.name,
            equal.ratio ? fmt::format("{:.2f} times the frame of {} (rmse {}; {:.2f} against {:.2f} ms)", *equal.ratio,
                                      equal.pcf, cell(equal.pcf_rmse, 4), *equal.technique_ms, *equal.pcf_ms)
                        : "no ratio, because " + equal.reason);
        if (equal.shadow_ratio) {
            text += fmt::format("    {:.2f} times without the {:.2f} ms of the frame without shadows\n",
                                *equal.shadow_ratio, *equal.without_ms);
        }
    }
    return text;
}

/// Which techniques' cascades were drawn which way; empty where there are none.
std::string cascadesText(const CompareResult& result)
{
    std::string text;
    for (const ComparedTechnique& technique : result.techniques) {
        if (const auto pass = cascadePassOf(technique.timed)) {
            text += fmt::format("  {}: {}\n", technique.name, nameOf(*pass));
        }
    }
    return text.empty() ? text : "\nmaps of cascades drawn:\n" + text;
}

std::string raysText(std::uint64_t rays)
{
    return rays == 0 ? "no rays" : fmt::format("{} ray{}", rays, rays == 1 ? "" : "s");
}

/// How fast, too, where the clock saw enough to tell.
std::string tracedText(std::uint64_t rays, double seconds)
{
    constexpr double kShortest_s = 0.005;
    constexpr double kMillion = 1e6;
    if (rays == 0) {
        return raysText(rays);
    }
    if (!(seconds >= kShortest_s)) {
        return raysText(rays) + " in less than 0.01 s";
    }
    const double speed = static_cast<double>(rays) / seconds;
    return fmt::format("{} in {:.2f} s, {:.3g} million/s", raysText(rays), seconds, speed / kMillion);
}

} // namespace

TextTable compareTable(const CompareResult& result, bool short_names)
{
    const std::string common = short_names ? commonParts(namesOf(result)) : std::string();
    const std::string path = short_names ? commonBlurPath(namesOf(result)) : std::string();
    const bool equal = hasEqualError(result);
    TextTable table;
    table.columns = {"technique"};
    const std::vector<std::string> errors = errorColumns();
    table.columns.insert(table.columns.end(), errors.begin(), errors.end());
    table.columns.insert(table.columns.end(), {"ssim", "flip", "ratio", "ms", "MiB"});
    if (result.path) {
        table.columns.insert(table.columns.begin() + 2, {"shimmer", "pop"});
    }
    if (equal) {
        table.columns.emplace_back("equal");
    }
    for (const ComparedTechnique& technique : result.techniques) {
        const lab::Score& score = technique.score;
        std::vector<std::string> row{withoutParts(withoutParts(technique.name, common), path)};
        addErrorCells(row, score.error, score.classification ? score.classification->errors : lab::ClassErrors{});
        if (technique.path) {
            const auto& stability = technique.path->stability;
            row.insert(row.begin() + 2, {cell(stability ? std::optional(stability->shimmer) : std::nullopt, 4),
                                         cell(stability ? std::optional(stability->pop) : std::nullopt, 4)});
        }
        row.push_back(cell(score.ssim, 3));
        row.push_back(cell(score.flip, 3));
        const double ratio = lab::frameRatio(technique.timed);
        row.push_back(cell(ratio > 0.0 ? std::optional(ratio) : std::nullopt, 2));
        row.push_back(cell(frameMedian(technique.timed.samples), 2));
        row.push_back(cell(static_cast<double>(totalBytes(technique.timed.added_memory)) / (1024.0 * 1024.0), 1));
        if (equal) {
            row.push_back(cell(technique.equal_error ? technique.equal_error->ratio : std::nullopt, 2));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string truthText(const CompareResult& result)
{
    const TruthFacts& truth = result.judged.facts;
    if (result.sweep && result.sweep->plan.remakes_shot) {
        std::uint64_t rays = 0;
        double seconds = 0.0;
        std::ptrdiff_t kept = 0;
        for (const SweepResult::Place& place : result.sweep->places) {
            rays += place.truth.rays;
            seconds += place.truth.seconds;
            kept += place.truth.from_cache ? 1 : 0;
        }
        return fmt::format(
            "{}, one for each value of {}; {}", truth.kind == truth::Kind::area ? "area" : "hard",
            result.sweep->plan.key,
            kept == 0 ? tracedText(rays, seconds)
                      : fmt::format("{} ({} of {} from the cache)", raysText(rays), kept, result.sweep->places.size()));
    }
    std::string text = "hard, one ray per pixel";
    if (tracedKind(truth) == truth::Kind::area) {
        text = fmt::format("area, {} rays per pixel, standard error {}", truth.samples, cell(result.standard_error, 4));
    } else if (truth.kind == truth::Kind::area) {
        text += ", for the light has no area";
    }
    return fmt::format("{}{}; {}", text, result.path ? ", at every frame" : "",
                       truth.from_cache ? raysText(truth.rays) + " (from the cache)"
                                        : tracedText(truth.rays, truth.seconds));
}

std::string pathText(const PathResult& path)
{
    return fmt::format("path:   {}, frames {} to {}", path.name, path.frames.first, path.frames.last);
}

std::string countedText(const CompareResult& result)
{
    return result.sweep && result.sweep->plan.remakes_shot
               ? fmt::format("in the table, for each value of {}", result.sweep->plan.key)
               : pixelsText(result.pixels);
}

std::string pixelsText(const lab::PixelCounts& pixels)
{
    const std::pair<std::uint64_t, const char*> reasons[] = {
        {pixels.background, "background"},
        {pixels.other_object, "where the sides see different objects"},
        {pixels.facing_away, "facing away"},
        {pixels.unlit, "outside the light's reach"},
        {pixels.no_receiver, "that receive no shadow"}};
    std::string text = fmt::format("{} counted", pixels.counted);
    std::string left;
    for (const auto& [count, reason] : reasons) {
        if (count != 0) {
            left += fmt::format("{}{} {}", left.empty() ? "" : ", ", count, reason);
        }
    }
    return text + (left.empty() ? ", none left out" : "; left out: " + left);
}

std::string pixelsNote(const lab::PixelCounts& pixels, std::uint64_t rays)
{
    constexpr std::uint64_t kFew = 20; // one in so many
    if (pixels.counted == 0) {
        return fmt::format("no pixel counts, so there are no error numbers: {}{}", pixelsText(pixels),
                           rays == 0 ? "; no ray was traced" : "");
    }
    const std::uint64_t surface = pixels.counted + pixels.leftOut() - pixels.background;
    if (pixels.counted * kFew >= surface) {
        return "";
    }
    return fmt::format("only {} of {} pixels with a surface count, so the error numbers say little of the picture: {}",
                       pixels.counted, surface, pixelsText(pixels));
}

std::string lightText(const host::ShadedLight& light)
{
    const Light& caster = light.caster;
    const auto point = [](const glm::dvec3& p) {
        return fmt::format("{:.4g},{:.4g},{:.4g}", p.x + 0.0, p.y + 0.0, p.z + 0.0); // no minus nothing
    };
    if (caster.type == LightType::directional) {
        return fmt::format("directional, direction {}, {:.3g} degrees wide", point(caster.direction_ws),
                           glm::degrees(caster.angular_diameter_rad));
    }
    return fmt::format("{}, at {}, radius {:.3g} m", nameOf(caster.type), point(caster.position_ws), caster.radius_m);
}

std::string compareText(const CompareResult& result, const Shot& shot, const Settings& settings)
{
    std::string text =
        fmt::format("{}, camera {}, {}x{}, light {}, on {} ({})\n", settings.scene, shot.camera, settings.size_px.x,
                    settings.size_px.y, result.light().name, result.device, result.driver);
    text += fmt::format("truth:  {}\n", truthText(result));
    text += fmt::format("pixels: {}\n", countedText(result));
    if (result.sweep) {
        return text + "\n" + fittedTableText(sweepTable(*result.sweep));
    }
    const std::string common = commonParts(namesOf(result));
    if (!common.empty()) {
        text += fmt::format("all with {}\n", common);
    }
    if (const std::string path = commonBlurPath(namesOf(result));
        !path.empty() && common.find(path) == std::string::npos) {
        text += fmt::format("blurred with {}\n", path);
    }
    if (result.path) {
        text += pathText(*result.path) + "; errors are means over them\n";
    }
    text += fmt::format("best first; ms: median frame of {}, ratio: to the frame without shadows ({:.2f} ms){}\n\n",
                        result.path ? result.techniques.front().timed.samples.size() : settings.repetitions,
                        frameMedian(result.baseline.samples),
                        hasEqualError(result) ? ",\nequal: to the cheapest PCF that errs no more" : "");
    text += fittedTableText(compareTable(result, true)) + cascadesText(result);
    return text + (hasEqualError(result) ? equalErrorText(result) : "");
}

} // namespace gnomon::app
