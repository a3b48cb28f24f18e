// SPDX-License-Identifier: Apache-2.0
// Text is made here and read without scripts; pages/page.js puts in pictures and charts.
#include "report_pages.h"

#include "compare_text.h"
#include "report_html.h"
#include "report_names.h"
#include "sweep.h"

#include "lab/report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon::app {
namespace {

/// The inputs and the method of the comparison, for a reader a year later.
std::string facts(const Json& result)
{
    std::string list = "<dl class=\"facts\">\n";
    const auto add = [&](std::string_view name, std::string_view text) {
        list += definition(name, text);
    };
    add("scene", fmt::format("{} ({})", textAt(result, "/scene"), textAt(result, "/scene_hash")));
    add("camera", textAt(result, "/camera"));
    add("light", fmt::format("{}: {}", textAt(result, "/light"), lightText(result.at("light_source"))));
    if (result.contains("sweep") && result.at("sweep").contains("truth")) {
        const Json& sweep = result.at("sweep");
        add("shown", fmt::format("scene, camera, light and the truth's picture at {}",
                                 placeText(textAt(sweep, "/key"), sweep.at("values")[0].get<double>())));
    }
    if (result.contains("path")) {
        add("path", fmt::format("{}, {} per second; camera and light are of the first", framesText(result),
                                *numberAt(result, "/path/fps")));
    }
    const Json& size = result.at("size_px");
    add("size", fmt::format("{} x {} pixels", size[0].dump(), size[1].dump()));
    add("truth", truthText(result));
    add("pixels", countedText(result));
    add("device", fmt::format("{} ({})", textAt(result, "/device"), textAt(result, "/driver")));
    add("version", textAt(result, "/version"));
    add("result", fmt::format("{}: every number, and the settings to repeat it", kReportResult));
    return list + "</dl>\n";
}

const Json& linesOf(const Json& result)
{
    return result.contains("sweep") ? result.at("sweep").at("results") : result.at("results");
}

std::string tableCaption(const Json& result, const std::string& common)
{
    const std::string order = result.contains("sweep")
                                  ? fmt::format("Every technique over {}.", textAt(result, "/sweep/key"))
                              : result.contains("path") ? std::string("Best first; means over the frames.")
                                                        : std::string("Best first.");
    return common.empty() ? order : fmt::format("{} All with {}.", order, common);
}

std::string numbers(const Json& result)
{
    const TextTable table = compareTable(result, true);
    const std::string caption = tableCaption(result, commonParts(techniqueNames(linesOf(result))));
    return tableHtml(table, {"techniques", caption, !result.contains("sweep")}) + meaningsHtml(table);
}

std::string lead(const Json& result)
{
    const std::size_t count = linesOf(result).size();
    const Json& size = result.at("size_px");
    std::string text = fmt::format("{} technique{} held against ray-traced truth: camera {}, light {}, {} x {}", count,
                                   count == 1 ? "" : "s", textAt(result, "/camera"), textAt(result, "/light"),
                                   size[0].dump(), size[1].dump());
    if (result.contains("sweep")) {
        text += ", over " + textAt(result, "/sweep/key");
    }
    return text + (result.contains("path") ? ", along " + framesText(result) : std::string());
}

std::string colourText(const std::array<std::uint8_t, 3>& rgb)
{
    return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

} // namespace

Json pageLegends()
{
    constexpr int kSteps = 16;
    constexpr double kOctaves = 4.0;
    Json error = Json::array();
    Json density = Json::array();
    for (int i = 0; i <= kSteps; ++i) {
        const double place = 2.0 * i / kSteps - 1.0;
        error.push_back(colourText(lab::errorRgb(place * std::abs(place)))); // the scale is the root of the error
        density.push_back(colourText(lab::densityRgb(std::exp2(place * kOctaves))));
    }
    using lab::ErrorClass;
    constexpr std::pair<const char*, ErrorClass> kClasses[] = {{"edge", ErrorClass::edge},
                                                               {"acne", ErrorClass::acne},
                                                               {"detached", ErrorClass::detached},
                                                               {"bleeding", ErrorClass::bleeding},
                                                               {"terminator", ErrorClass::terminator}};
    Json classes;
    for (const auto& [name, error_class] : kClasses) {
        classes[name] = colourText(lab::classRgb(error_class));
    }
    return {{"error", error}, {"density", density}, {"classes", classes}};
}

std::string comparePage(const Json& result, const Json& pictures)
{
    Json data{{"result", result}, {"legends", pageLegends()}, {"names", shortNames(techniqueNames(linesOf(result)))}};
    // The first three are filled by the scripts.
    const std::string body = "<div id=\"look\"></div>\n<div id=\"panes\"></div>\n<div id=\"charts\"></div>\n" +
                             section("numbers", "Numbers", numbers(result)) +
                             section("notes", "Notes", notesHtml(result)) +
                             section("facts", "What was compared", facts(result));
    return pageHtml({.kind = result.contains("sweep") ? "sweep" : "compare",
                     .title = "Shadows of " + textAt(result, "/scene"),
                     .lead = lead(result),
                     .body = body,
                     .data = std::move(data),
                     .pictures = pictures});
}

} // namespace gnomon::app
