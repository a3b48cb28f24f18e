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
        text += equal.ratio ? fmt::format("  {}: {:.2f} times the frame of {} (rmse {}; {:.2f} against {:.2f} ms)\n",
                                          technique.name, *equal.ratio, equal.pcf, cell(equal.pcf_rmse, 4),
                                          *equal.technique_ms, *equal.pcf_ms)
                            : fmt::format("  {}: none: {}\n", technique.name, equal.reason);
    }
    return text;
}

} // namespace

TextTable compareTable(const CompareResult& result, bool short_names)
{
    const std::string common = short_names ? commonParts(namesOf(result)) : std::string();
    const bool equal = hasEqualError(result);
    TextTable table;
    table.columns = {"technique"};
    const std::vector<std::string> errors = errorColumns();
    table.columns.insert(table.columns.end(), errors.begin(), errors.end());
    table.columns.insert(table.columns.end(), {"ssim", "flip", "ratio", "ms", "MiB"});
    if (equal) {
        table.columns.emplace_back("equal");
    }
    for (const ComparedTechnique& technique : result.techniques) {
        const lab::Score& score = technique.score;
        std::vector<std::string> row{short_names ? withoutParts(technique.name, common) : technique.name};
        addErrorCells(row, score.error, score.classification ? score.classification->errors : lab::ClassErrors{});
        row.push_back(cell(score.ssim, 3));
        row.push_back(cell(score.flip, 3));
        const double ratio = lab::frameRatio(technique.timed, result.baseline);
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
    const truth::Visibility& visibility = result.truth.visibility;
    const bool area = visibility.kind == truth::Kind::area;
    std::string text =
        area ? fmt::format("area, {} rays per pixel, standard error {}", result.samples, cell(result.standard_error, 4))
             : std::string("hard, one ray per pixel");
    constexpr double kMillion = 1e6;
    const double rays = static_cast<double>(visibility.rays);
    text += fmt::format("; {} rays in {:.2f} s", visibility.rays, visibility.seconds);
    if (rays > 0.0 && visibility.seconds > 0.0) {
        text += fmt::format(", {:.2f} million/s", rays / visibility.seconds / kMillion);
    }
    return text + (result.from_cache ? " (from the cache)" : "");
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
                    settings.size_px.y, result.light.name, result.device, result.driver);
    text += fmt::format("truth:  {}\n", truthText(result));
    text += fmt::format("pixels: {}\n", pixelsText(result.pixels));
    if (result.sweep) {
        return text + "\n" + tableText(sweepTable(*result.sweep));
    }
    if (const std::string common = commonParts(namesOf(result)); !common.empty()) {
        text += fmt::format("all with {}\n", common);
    }
    text += fmt::format("best first; ms: median frame of {}, ratio: to the frame without shadows ({:.2f} ms)\n\n",
                        settings.repetitions, frameMedian(result.baseline.samples));
    text += tableText(compareTable(result, true));
    return text + (hasEqualError(result) ? equalErrorText(result) : "");
}

} // namespace gnomon::app
