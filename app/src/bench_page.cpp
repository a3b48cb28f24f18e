// SPDX-License-Identifier: Apache-2.0
// A bench's JSON in tables: for the terminal, and for the page of a report.
#include "report_html.h"
#include "report_pages.h"
#include "technique_json.h"

#include <fmt/format.h>

#include <algorithm>
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

std::string mebibytesCell(const Json& json, const char* where, int decimals)
{
    const std::optional<double> bytes = numberAt(json, where);
    return cell(bytes ? std::optional(*bytes / (1024.0 * 1024.0)) : std::nullopt, decimals);
}

TextTable timesTable(const Json& result, const std::vector<std::string>& names)
{
    TextTable table{{"technique"}, {}, {""}};
    const auto row = [&](const std::string& name, const Json& json) {
        table.rows.push_back({name});
        for (const Column& column : kTimes) {
            table.rows.back().push_back(cell(numberAt(json, column.where), column.decimals));
        }
        table.rows.back().push_back(mebibytesCell(json, "/memory_bytes", 2));
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

constexpr const char* kOfPass[] = {"/ms", "/iqr_ms", "/share"};

/// The passes of the one technique, beside the frame without shadows. With several techniques it is empty: it would be
/// long, and results have it.
std::string passText(const Json& result)
{
    if (result.at("results").size() != 1) {
        return {};
    }
    const Json& technique = result.at("results")[0];
    const Json& without = result.at("baseline").at("passes");
    const std::optional<double> frame_ms = numberAt(technique, "/time_ms/frame");
    std::optional<double> outside_ms = frame_ms;
    TextTable table{{"pass", "ms", "iqr", "share", "without", "vertices", "fragments", "compute", "draws", "least MiB"},
                    {}};
    for (const Json& pass : technique.at("passes")) {
        const auto same = std::ranges::find_if(
            without, [&](const Json& other) { return textAt(other, "/name") == textAt(pass, "/name"); });
        const std::optional<double> ms = numberAt(pass, "/ms");
        outside_ms = outside_ms && ms ? std::optional(*outside_ms - *ms) : std::nullopt;
        std::vector<std::string>& row = table.rows.emplace_back(std::vector{textAt(pass, "/name")});
        for (const char* number : kOfPass) {
            row.push_back(cell(numberAt(pass, number), 3));
        }
        row.push_back(cell(same == without.end() ? std::nullopt : numberAt(*same, "/ms"), 3));
        for (const char* count : {"/vertex_invocations", "/fragment_invocations", "/compute_invocations", "/draws"}) {
            row.push_back(cell(numberAt(pass, count), 0));
        }
        row.push_back(mebibytesCell(pass, "/bytes_minimum", 2));
    }
    const bool is_shared = outside_ms && frame_ms && *frame_ms > 0.0;
    table.rows.push_back({"outside", cell(outside_ms, 3), std::string(kNoNumber),
                          cell(is_shared ? std::optional(*outside_ms / *frame_ms) : std::nullopt, 3)});
    table.rows.back().resize(table.columns.size(), std::string(kNoNumber));
    return "\n" + fittedTableText(table);
}

/// Adds a row for each technique: its name and the cells that `cells` makes, unless these are none.
template <typename Cells>
std::string techniquesText(const Json& result, std::vector<std::string> columns, const Cells& cells)
{
    TextTable table{std::move(columns), {}};
    for (const Json& technique : result.at("results")) {
        std::vector<std::string> row = cells(technique);
        if (!row.empty()) {
            row.insert(row.begin(), textAt(technique, "/technique"));
            table.rows.push_back(std::move(row));
        }
    }
    return table.rows.empty() ? std::string() : "\n" + fittedTableText(table);
}

/// The cost of blurring maps, for each technique that blurs.
std::vector<std::string> blurCells(const Json& technique)
{
    const Json& counters = technique.at("counters");
    if (counters.at("blur_path").is_null()) {
        return {};
    }
    const double texels = *numberAt(counters, "/texels_filtered");
    return {textAt(counters, "/blur_path"),
            cell(texels / 1e6, 2),
            cell(*numberAt(counters, "/filter_taps") / texels, 1),
            mebibytesCell(counters, "/filter_bytes", 1),
            mebibytesCell(counters, "/filter_bytes_minimum", 1),
            cell(numberAt(counters, "/filter_bytes_ratio"), 2)};
}

/// How cascades were drawn, for each technique that has them.
std::vector<std::string> cascadeCells(const Json& technique)
{
    return technique.at("cascade_pass").is_null() ? std::vector<std::string>()
                                                  : std::vector{textAt(technique, "/cascade_pass")};
}

std::vector<std::string> reuseCells(const Json& technique)
{
    std::vector<std::string> cells;
    for (const auto& [name, mean] : technique.at("static_reuse").items()) {
        cells.push_back(cell(mean.get<double>(), 2));
    }
    return cells;
}

} // namespace

std::string benchText(const Json& result, std::uint32_t map_side)
{
    const bool has_path = result.contains("path");
    std::string text = fmt::format(
        "{}, camera {}, {}, map {}, on {} ({})\nmedian milliseconds of {} frames{}; static: maps that still hold are "
        "kept, still: masks too\n\n",
        textAt(result, "/scene"), textAt(result, "/camera"), textAt(result, "/settings/size"), map_side,
        textAt(result, "/device"), textAt(result, "/driver"), result.at("frames_timed").dump(),
        has_path ? fmt::format(" along {} from {}", textAt(result, "/path/name"),
                               result.at("path").at("frames").at("first").dump())
                 : "");
    text += tableText(timesTable(result, techniqueNames(result.at("results"))));
    for (const Json& missing : result.at("not_measured")) {
        text += missing.get<std::string>() + "\n";
    }
    std::vector<std::string> reuse{"maps that hold kept, per frame"};
    for (const ReuseCounter& counter : reuseCounters({})) {
        reuse.emplace_back(counter.title);
    }
    return text + passText(result) +
           techniquesText(result, {"blur", "path", "Mtexels", "taps/texel", "MiB moved", "least", "ratio"}, blurCells) +
           techniquesText(result, {"cascades", "drawn"}, cascadeCells) +
           (has_path ? techniquesText(result, reuse, reuseCells) : "");
}

std::string benchPage(const Json& result)
{
    const std::size_t count = result.at("results").size();
    const std::vector<std::string> whole = techniqueNames(result.at("results"));
    const std::string common = commonParts(whole);
    std::vector<std::string> names;
    names.reserve(whole.size());
    for (const std::string& name : whole) {
        names.push_back(withoutParts(name, common));
    }
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
