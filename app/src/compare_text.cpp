// SPDX-License-Identifier: Apache-2.0
#include "compare_text.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace gnomon::app {
namespace {

enum class Form : std::uint8_t { plain, with_sign, share_of_squared_rmse, mebibytes };

struct Column {
    const char* name;
    const char* with;  // a table has the column where its result has this; empty: always
    const char* where; // its number in a row of rowsOf()
    int decimals;
    Form form;
    const char* meaning; // a sentence without its end
};

constexpr Column kColumns[] = {
    {"rmse", "", "/error/rmse", 4, Form::plain,
     "root of the mean squared error of the mask, whose values go from 0 to 1; 0 is best"},
    {"shimmer", "/path", "/stability/shimmer", 4, Form::plain,
     "root of the mean squared change of the error from frame to frame, at the same points; 0 is best"},
    {"pop", "/path", "/stability/pop", 4, Form::plain,
     "the largest mean change of the error from one frame to the next; 0 is best"},
    {"mae", "", "/error/mae", 4, Form::plain, "mean absolute error of the mask; 0 is best"},
    {"bias", "", "/error/bias", 4, Form::with_sign,
     "mean error: below 0 the shadows are too dark or too large, above 0 too light; 0 is best"},
    {"edge%", "", "/error/edge", 1, Form::share_of_squared_rmse,
     "share of the squared error at the rims of shadows: stairs, a penumbra of the wrong width"},
    {"acne%", "", "/error/acne", 1, Form::share_of_squared_rmse,
     "share of the squared error on lit surfaces that shadow themselves"},
    {"det%", "", "/error/detached", 1, Form::share_of_squared_rmse,
     "share of the squared error in light between an object and its shadow"},
    {"bleed%", "", "/error/bleeding", 1, Form::share_of_squared_rmse,
     "share of the squared error in light inside a shadow, far behind what casts it"},
    {"term%", "", "/error/terminator", 1, Form::share_of_squared_rmse,
     "share of the squared error where smooth-shaded bodies turn away from the light"},
    {"graze", "/results/0/grazing", "/grazing/rmse", 4, Form::plain,
     "rmse of the pixels that light all but grazes, which are in no other number; 0 is best"},
    {"ssim", "/baseline", "/error/ssim", 3, Form::plain, "structural similarity of the mask to the truth; 1 is best"},
    {"flip", "/baseline", "/error/flip", 3, Form::plain, "what an eye sees when mask and truth alternate; 0 is best"},
    {"ratio", "/baseline", "/frame_ratio", 2, Form::plain,
     "median frame divided by the frame without shadows; 1 costs nothing"},
    {"ms", "/baseline", "/time_ms/frame", 2, Form::plain,
     "median frame in milliseconds, every map drawn anew in every frame"},
    {"MiB", "/baseline", "/memory_bytes", 1, Form::mebibytes, "memory beyond the frame without shadows"},
    {"equal", "/results/0/equal_error", "/equal_error_ratio", 2, Form::plain,
     "median frame divided by that of the cheapest PCF that errs no more; below 1 the better buy"},
    {"truth+-", "/sweep/truth", "/truth/standard_error", 4, Form::plain, "standard error of the truth itself"},
    {"pixels", "/sweep/truth", "/pixels/counted", 0, Form::plain, "how many pixels count"}};

bool has(const Json& result, const char* pointer)
{
    return result.contains(Json::json_pointer(pointer));
}

/// The points of a sweep as techniques are: "technique", "value", "error" and, where each has its own, "truth" and
/// "pixels".
Json pointsOf(const Json& sweep)
{
    Json points = Json::array();
    for (const Json& line : sweep.at("results")) {
        for (std::size_t i = 0; i < sweep.at("values").size(); ++i) {
            Json point{{"technique", line.at("technique")}, {"value", sweep.at("values")[i]}};
            for (const auto& [key, list] : line.items()) {
                if (list.is_array() && key != "commands") {
                    point["error"][key] = list[i];
                }
            }
            for (const char* key : {"truth", "pixels"}) {
                if (sweep.contains(key)) {
                    point[key] = sweep.at(key)[i];
                }
            }
            points.push_back(std::move(point));
        }
    }
    return points;
}

std::string cellOf(const Column& column, const Json& row)
{
    std::optional<double> number = numberAt(row, column.where);
    if (number && column.form == Form::share_of_squared_rmse) {
        const double rmse = numberAt(row, "/error/rmse").value_or(0.0);
        number = rmse > 0.0 ? std::optional(100.0 * *number / (rmse * rmse)) : std::nullopt;
    } else if (number && column.form == Form::mebibytes) {
        *number /= 1024.0 * 1024.0;
    }
    std::string text = cell(number, column.decimals);
    if (number && column.form == Form::with_sign) {
        const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
        text = is_zero ? cell(0.0, column.decimals) : (*number > 0.0 ? "+" : "") + text;
    }
    return text;
}

/// As it stands in the table.
std::string valueCell(double value)
{
    return std::floor(value) == value ? fmt::format("{:.0f}", value + 0.0) : fmt::format("{:.4g}", value);
}

/// The match of every technique, a line each; empty where none was looked for.
std::string equalErrorText(const Json& result)
{
    std::string text;
    for (const Json& technique : result.at("results")) {
        if (!technique.contains("equal_error")) {
            continue;
        }
        const auto number = [&](const char* pointer, int decimals) {
            return cell(numberAt(technique, pointer), decimals);
        };
        const bool found = technique.at("equal_error_ratio").is_number();
        text += fmt::format(
            "  {}: {}\n", textAt(technique, "/technique"),
            found ? fmt::format("{} times the frame of {} (rmse {}; {} against {} ms)", number("/equal_error_ratio", 2),
                                textAt(technique, "/equal_error/technique"), number("/equal_error/rmse", 4),
                                number("/equal_error/frame_ms/technique", 2), number("/equal_error/frame_ms/pcf", 2))
                  : "no ratio, because " + textAt(technique, "/equal_error/reason"));
        if (technique.at("equal_error_shadow_ratio").is_number()) {
            text +=
                fmt::format("    {} times without the {} ms of the frame without shadows\n",
                            number("/equal_error_shadow_ratio", 2), number("/equal_error/frame_ms/without_shadows", 2));
        }
    }
    return text.empty() ? text : "\nPCF of equal error, timed in turn with each technique:\n" + text;
}

/// Which techniques' cascades were drawn which way; empty where there are none.
std::string cascadesText(const Json& result)
{
    std::string text;
    for (const Json& technique : result.at("results")) {
        if (technique.at("cascade_pass").is_string()) {
            text += fmt::format("  {}: {}\n", textAt(technique, "/technique"), textAt(technique, "/cascade_pass"));
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

/// Where a sweep has a truth for each value.
std::string truthsText(const Json& sweep)
{
    std::uint64_t rays = 0;
    double seconds = 0.0;
    std::size_t kept = 0;
    const Json& truths = sweep.at("truth");
    for (const Json& truth : truths) {
        rays += truth.at("rays").get<std::uint64_t>();
        seconds += numberAt(truth, "/seconds").value_or(0.0);
        kept += truth.at("from_cache").get<bool>() ? 1U : 0U;
    }
    return fmt::format("{}, one for each value of {}; {}", textAt(truths[0], "/requested"), textAt(sweep, "/key"),
                       kept == 0 ? tracedText(rays, seconds)
                                 : fmt::format("{} ({} of {} from the cache)", raysText(rays), kept, truths.size()));
}

} // namespace

TextTable compareTable(const Json& result, bool short_names)
{
    const bool sweep = result.contains("sweep");
    const Json rows = sweep ? pointsOf(result.at("sweep")) : result.at("results");
    TextTable table{{"technique"}, {}, {""}};
    for (const std::string& name : short_names ? shortNames(techniqueNames(rows)) : techniqueNames(rows)) {
        table.rows.push_back({name});
    }
    if (sweep) {
        table.columns.push_back(textAt(result, "/sweep/key"));
        table.meanings.emplace_back();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            table.rows[i].push_back(valueCell(rows[i].at("value").get<double>()));
        }
    }
    for (const Column& column : kColumns) {
        if (!has(result, column.with)) {
            continue;
        }
        table.columns.emplace_back(column.name);
        table.meanings.emplace_back(column.meaning);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            table.rows[i].push_back(cellOf(column, rows[i]));
        }
    }
    return table;
}

std::string truthText(const Json& result)
{
    if (has(result, "/sweep/truth")) {
        return truthsText(result.at("sweep"));
    }
    const Json& truth = result.at("truth");
    const auto rays = truth.at("rays").get<std::uint64_t>();
    const bool over_pixels = truth.value("pixels", "centre") == "area";
    std::string text = "hard, one ray per pixel";
    if (truth.at("kind") == "area" || over_pixels) {
        text = fmt::format("{}, {} rays per pixel{}, standard error {}", truth.at("kind").get<std::string>(),
                           truth.at("samples").dump(), over_pixels ? " over its area" : "",
                           cell(numberAt(truth, "/standard_error"), 4));
    }
    if (truth.at("kind") != "area" && truth.at("requested") == "area") {
        text += ", for the light has no area";
    }
    return fmt::format("{}{}; {}", text, result.contains("path") ? ", at every frame" : "",
                       truth.at("from_cache").get<bool>()
                           ? raysText(rays) + " (from the cache)"
                           : tracedText(rays, numberAt(truth, "/seconds").value_or(0.0)));
}

std::string framesText(const Json& result)
{
    const Json& path = result.at("path");
    return fmt::format("{}, frames {} to {}", textAt(path, "/name"), path.at("frames").at("first").dump(),
                       path.at("frames").at("last").dump());
}

std::string countedText(const Json& result)
{
    return has(result, "/sweep/truth") ? "in the table, for each value of " + textAt(result, "/sweep/key")
                                       : pixelsText(result.at("pixels"));
}

std::string pixelsText(const Json& pixels)
{
    constexpr std::pair<const char*, const char*> kReasons[] = {
        {"background", "background"},
        {"other_object", "where the sides see different objects"},
        {"facing_away", "facing away"},
        {"unlit", "outside the light's reach"},
        {"no_receiver", "that receive no shadow"},
        {"grazing", "that light all but grazes"}};
    std::string left;
    for (const auto& [key, reason] : kReasons) {
        if (const Json& count = pixels.at("left_out_by_reason").at(key); count != 0) {
            left += fmt::format("{}{} {}", left.empty() ? "" : ", ", count.dump(), reason);
        }
    }
    return pixels.at("counted").dump() + " counted" + (left.empty() ? ", none left out" : "; left out: " + left);
}

std::string lightText(const Json& light)
{
    const auto point = [&](const char* key) {
        const auto p = light.at(key).get<std::array<double, 3>>();
        return fmt::format("{:.4g},{:.4g},{:.4g}", p[0], p[1], p[2]);
    };
    if (light.at("type") == "directional") {
        return fmt::format("directional, direction {}, {:.3g} degrees wide", point("direction_ws"),
                           glm::degrees(light.at("angular_diameter_rad").get<double>()));
    }
    return fmt::format("{}, at {}, radius {:.3g} m", textAt(light, "/type"), point("position_ws"),
                       light.at("radius_m").get<double>());
}

std::string compareText(const Json& result)
{
    const Json& size = result.at("size_px");
    std::string text = fmt::format("{}, camera {}, {}x{}, light {}, on {} ({})\n", textAt(result, "/scene"),
                                   textAt(result, "/camera"), size[0].dump(), size[1].dump(), textAt(result, "/light"),
                                   textAt(result, "/device"), textAt(result, "/driver"));
    text += fmt::format("truth:  {}\n", truthText(result));
    text += fmt::format("pixels: {}\n", countedText(result));
    if (result.contains("sweep")) {
        return text + "\n" + fittedTableText(compareTable(result, false));
    }
    const std::vector<std::string> names = techniqueNames(result.at("results"));
    const std::string common = commonParts(names);
    if (!common.empty()) {
        text += fmt::format("all with {}\n", common);
    }
    if (const std::string path = commonBlurPath(names); !path.empty() && common.find(path) == std::string::npos) {
        text += fmt::format("blurred with {}\n", path);
    }
    if (result.contains("path")) {
        text += fmt::format("path:   {}; errors are means over them\n", framesText(result));
    }
    const std::string equal = equalErrorText(result);
    text += fmt::format("best first; ms: median frame of {}, ratio: to the frame without shadows ({} ms){}\n\n",
                        result.at("results").at(0).at("frames_timed").dump(),
                        cell(numberAt(result, "/baseline/time_ms/frame"), 2),
                        equal.empty() ? "" : ",\nequal: to the cheapest PCF that errs no more");
    return text + fittedTableText(compareTable(result, true)) + cascadesText(result) + equal;
}

} // namespace gnomon::app
