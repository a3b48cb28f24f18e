// SPDX-License-Identifier: Apache-2.0
#include "report_pages.h"

#include "report_html.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace gnomon::app {
namespace {

struct Column {
    const char* name;
    const char* where; // its number in a technique's JSON
    int decimals;
    const char* meaning; // a sentence without its end
};
constexpr double kMiB = 1024.0 * 1024.0;

constexpr Column kTimes[] = {
    {"plan", "/time_ms/plan", 3, "median milliseconds of planning, on the CPU"},
    {"maps", "/time_ms/maps", 3, "of drawing maps, every one anew in every frame"},
    {"filter", "/time_ms/filter", 3, "of making maps filterable"},
    {"mask", "/time_ms/mask", 3, "of the visibility mask"},
    {"frame", "/time_ms/frame", 3, "of the whole frame"},
    {"iqr", "/iqr_ms/frame", 3, "interquartile range of the whole frame: the middle half of the samples"},
    {"ratio", "/frame_ratio", 2, "median frame divided by the frame without shadows; 1 costs nothing"},
    {"static", "/static_time_ms/frame", 3, "median frame where maps that still hold are kept"},
    {"static ratio", "/static_frame_ratio", 2, "that, divided by the frame without shadows"},
    {"still", "/still_time_ms/frame", 3, "median frame where masks that still hold are kept, too"},
    {"still ratio", "/still_frame_ratio", 2, "that, divided by the frame without shadows"}};

constexpr Column kPass[] = {{"ms", "/ms", 3, "median milliseconds"},
                            {"iqr", "/iqr_ms", 3, "their interquartile range"},
                            {"vertices", "/vertex_invocations", 0, "invocations of vertex shaders"},
                            {"primitives", "/primitives", 0, ""},
                            {"fragments", "/fragment_invocations", 0, "invocations of fragment shaders"},
                            {"compute", "/compute_invocations", 0, "invocations of compute shaders"},
                            {"draws", "/draws", 0, ""},
                            {"texels", "/texels", 0, ""}};

/// The names of a result's techniques without the parts that all of them have, and those parts.
struct Names {
    std::vector<std::string> names;
    std::string common;
};

Names namesOf(const Json& result)
{
    Names names;
    for (const Json& technique : result.at("results")) {
        names.names.push_back(textAt(technique, "/technique"));
    }
    names.common = commonParts(names.names);
    for (std::string& name : names.names) {
        name = withoutParts(name, names.common);
    }
    return names;
}

TextTable timesTable(const Json& result, const std::vector<std::string>& names)
{
    TextTable table{{"technique"}, {}, {""}};
    const auto row = [&](const std::string& name, const Json& json) {
        table.rows.push_back({name});
        for (const Column& column : kTimes) {
            table.rows.back().push_back(cell(numberAt(json, column.where), column.decimals));
        }
        const std::optional<double> bytes = numberAt(json, "/memory_bytes");
        table.rows.back().push_back(cell(bytes ? std::optional(*bytes / kMiB) : std::nullopt, 2));
    };
    for (const Column& column : kTimes) {
        table.columns.emplace_back(column.name);
        table.meanings.emplace_back(column.meaning);
    }
    table.columns.emplace_back("MiB");
    table.meanings.emplace_back("memory beyond the frame without shadows, whose own stands in its row");
    for (std::size_t i = 0; i < names.size(); ++i) {
        row(names[i], result.at("results")[i]);
    }
    Json without = result.at("baseline");
    without["frame_ratio"] = 1.0;
    row("no shadows", without);
    return table;
}

TextTable passesTable(const Json& result, const std::vector<std::string>& names)
{
    TextTable table{{"technique", "pass"}, {}, {"", ""}};
    for (const Column& column : kPass) {
        table.columns.emplace_back(column.name);
        table.meanings.emplace_back(column.meaning);
    }
    const auto rows = [&](const std::string& name, const Json& passes) {
        for (const Json& pass : passes) {
            table.rows.push_back({name, textAt(pass, "/name")});
            for (const Column& column : kPass) {
                table.rows.back().push_back(cell(numberAt(pass, column.where), column.decimals));
            }
        }
    };
    for (std::size_t i = 0; i < names.size(); ++i) {
        rows(names[i], result.at("results")[i].at("passes"));
    }
    rows("no shadows", result.at("baseline").at("passes"));
    return table;
}

std::string facts(const Json& result)
{
    std::string lights;
    for (const Json& light : result.at("lights")) {
        lights += fmt::format("{}{} ({})", lights.empty() ? "" : ", ", textAt(light, "/name"), textAt(light, "/type"));
    }
    std::string missing;
    for (const Json& sentence : result.at("not_measured")) {
        missing += (missing.empty() ? "" : "; ") + sentence.get<std::string>();
    }
    missing = missing.empty() ? "nothing" : missing;
    return "<dl class=\"facts\">\n" +
           definition("scene", fmt::format("{} ({})", textAt(result, "/scene"), textAt(result, "/scene_hash"))) +
           definition("camera", textAt(result, "/camera")) + definition("lights", lights) +
           definition("size", textAt(result, "/settings/size")) +
           definition("device", fmt::format("{} ({})", textAt(result, "/device"), textAt(result, "/driver"))) +
           definition("not measured", missing) + definition("version", textAt(result, "/version")) +
           definition("result", "result.json: every number, and the settings to repeat it") + "</dl>\n";
}

} // namespace

std::string benchPage(const Json& result)
{
    const std::size_t count = result.at("results").size();
    const auto [names, common] = namesOf(result);
    const TextTable times = timesTable(result, names);
    const TextTable passes = passesTable(result, names);
    const std::string caption = "Median milliseconds; ratios are to the frame without shadows." +
                                (common.empty() ? std::string() : fmt::format(" All with {}.", common));
    const std::string body =
        "<div id=\"look\"></div>\n<div id=\"charts\"></div>\n" +
        section("numbers", "Times", tableHtml(times, {"techniques", caption, true}) + meaningsHtml(times)) +
        section("counters", "Passes and what they counted",
                tableHtml(passes, {"passes", "Of frames in which every map is drawn anew.", false}) +
                    meaningsHtml(passes)) +
        section("facts", "What was measured", facts(result));
    return pageHtml({.kind = "bench",
                     .title = "Times of shadows in " + textAt(result, "/scene"),
                     .lead = fmt::format("{} technique{} beside the frame without shadows: camera {}, {}, on {}", count,
                                         count == 1 ? "" : "s", textAt(result, "/camera"),
                                         textAt(result, "/settings/size"), textAt(result, "/device")),
                     .body = body,
                     .data = {{"result", result}, {"names", names}},
                     .pictures = nullptr});
}

} // namespace gnomon::app
