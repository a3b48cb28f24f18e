// SPDX-License-Identifier: Apache-2.0
#include "compare_scenes.h"

#include "compare_folder.h"
#include "compare_table.h"
#include "compare_text.h"
#include "lab/report.h"
#include "report_html.h"
#include "report_pages.h"
#include "streams.h"
#include "subcommands.h"
#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>

namespace gnomon::app {

namespace fs = std::filesystem;

namespace {

/// The text as a folder's name that is valid on any system and in a link.
std::string plainName(std::string text)
{
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    for (std::size_t at = 0; (at = text.find_first_not_of(kPlain, at)) != std::string::npos;) {
        text[at] = '_';
    }
    return text.empty() ? "scene" : text;
}

/// The names of scenes in tables and folders. A file has its name without its extension; a repeated name has a number.
std::vector<std::string> labelsOf(const std::vector<std::string>& scenes)
{
    std::vector<std::string> labels;
    for (const std::string& scene : scenes) {
        const std::string name = plainName(fs::path(scene).stem().string());
        std::string label = name;
        for (int i = 2; std::find(labels.begin(), labels.end(), label) != labels.end(); ++i) {
            label = fmt::format("{}-{}", name, i);
        }
        labels.push_back(std::move(label));
    }
    return labels;
}

/// The technique's among the results of a scene; null where it has none there.
Json errorOf(const Json& result, const std::string& technique)
{
    for (const Json& one : result.at("results")) {
        if (textAt(one, "/technique") == technique) {
            return one.contains("error") && one.at("error").is_object() ? one.at("error").value("rmse", Json())
                                                                        : Json();
        }
    }
    return {};
}

/// The geometric mean, in which a scene counts as much as any other, however large its errors are; errors that nobody
/// sees all alike, so that an exact one is not worth more than all others. Null where an error is not known.
Json meanOf(const Json& errors)
{
    constexpr double kUnseen = 0.001;
    double sum = 0.0;
    for (const Json& error : errors) {
        if (!error.is_number()) {
            return {};
        }
        sum += std::log(std::max(error.get<double>(), kUnseen));
    }
    return std::exp(sum / static_cast<double>(errors.size()));
}

/// The errors of all techniques over the scenes, the least mean first.
Json overScenes(const Json& scenes)
{
    std::vector<Json> techniques;
    for (const Json& first : scenes.at(0).at("result").at("results")) {
        Json one{{"technique", textAt(first, "/technique")}, {"rmse", Json::array()}};
        for (const Json& scene : scenes) {
            one["rmse"].push_back(errorOf(scene.at("result"), textAt(first, "/technique")));
        }
        one["mean"] = meanOf(one["rmse"]);
        techniques.push_back(std::move(one));
    }
    const auto mean = [](const Json& one) {
        return one.at("mean").is_number() ? one.at("mean").get<double>() : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(techniques.begin(), techniques.end(),
                     [&](const Json& a, const Json& b) { return mean(a) < mean(b); });
    return techniques;
}

TextTable tableOf(const Json& scenes)
{
    constexpr int kDecimals = 4;
    TextTable table;
    table.columns = {"technique"};
    table.meanings = {""};
    for (const Json& scene : scenes.at("scenes")) {
        table.columns.push_back(textAt(scene, "/name"));
        table.meanings.push_back("rmse in " + textAt(scene, "/name"));
    }
    table.columns.emplace_back("mean");
    table.meanings.emplace_back(
        "geometric mean of the errors, those below 0.001 as 0.001: each scene counts as much as any other");
    const std::vector<std::string> names = shortNames(techniqueNames(scenes.at("techniques")));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Json& one = scenes.at("techniques")[i];
        table.rows.push_back({names[i]});
        for (std::size_t k = 0; k < scenes.at("scenes").size(); ++k) {
            table.rows.back().push_back(cell(numberAt(one, fmt::format("/rmse/{}", k).c_str()), kDecimals));
        }
        table.rows.back().push_back(cell(numberAt(one, "/mean"), kDecimals));
    }
    return table;
}

/// A link to each scene's own report, with what it is of.
std::string linksHtml(const Json& scenes)
{
    std::string list = "<ul class=\"scenes\">\n";
    for (const Json& scene : scenes.at("scenes")) {
        const Json& result = scene.at("result");
        list += fmt::format("<li><a href=\"{0}/{1}\">{0}</a>: {2}, camera {3}, light {4}</li>\n",
                            escaped(textAt(scene, "/name")), kReportPage, escaped(textAt(result, "/scene")),
                            escaped(textAt(result, "/camera")), escaped(textAt(result, "/light")));
    }
    return list + "</ul>\n";
}

void makeFolder(const fs::path& folder)
{
    std::error_code fault;
    fs::create_directory(folder, fault);
    if (fault || !fs::is_directory(folder, fault)) {
        throw Error("writing the report " + folder.string(), fault ? fault.message() : "it is no folder");
    }
}

} // namespace

Json compareScenes(const Settings& settings)
{
    if (settings.sweep) {
        throw UsageError("--sweep is of one scene; there are several");
    }
    for (const std::string& scene : settings.scenes) { // the last one's name is wrong as often as the first one's
        worlds::requireThere(scene);
    }
    const std::vector<std::string> labels = labelsOf(settings.scenes);
    std::unique_ptr<ReportFolder> folder;
    if (!settings.report.empty()) {
        folder = std::make_unique<ReportFolder>(settings.report, std::vector<std::string>{kReportPage, kReportResult});
        makeFolder(settings.report);
    }
    Json all{{"scenes", Json::array()}};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        Settings one = settings;
        one.scene = settings.scenes[i];
        one.scenes.clear();
        one.scene_hash = i == 0 ? settings.scene_hash : "";
        if (folder) {
            one.report = (fs::path(settings.report) / labels[i]).string();
        }
        notice(fmt::format("scene {} of {}: {}", i + 1, labels.size(), one.scene));
        all["scenes"].push_back({{"name", labels[i]}, {"result", findByComparing(one)}});
    }
    all["techniques"] = overScenes(all.at("scenes"));
    if (folder) {
        all["report_files"] = folder->listed();
        const std::string text = jsonText(all);
        folder->write(kReportResult, text);
        folder->write(kReportPage, scenesPage(Json::parse(text)));
        folder->keep();
    }
    return all;
}

std::string scenesText(const Json& scenes)
{
    std::string text;
    for (const Json& scene : scenes.at("scenes")) {
        text += compareText(scene.at("result")) + "\n";
    }
    return text + "rmse in all scenes, the least mean first\n" + fittedTableText(tableOf(scenes));
}

std::string scenesPage(const Json& scenes)
{
    const TextTable table = tableOf(scenes);
    const std::size_t count = scenes.at("techniques").size();
    const std::string body =
        "<div id=\"charts\"></div>\n" +
        section("numbers", "Error in every scene",
                tableHtml(table, {"techniques", "The least mean first.", true}) + meaningsHtml(table)) +
        section("scenes", "The scenes", linksHtml(scenes));
    Json data{
        {"result", scenes}, {"names", shortNames(techniqueNames(scenes.at("techniques")))}, {"legends", pageLegends()}};
    return pageHtml({.kind = "scenes",
                     .title = fmt::format("Shadows of {} scenes", scenes.at("scenes").size()),
                     .lead = fmt::format("{} technique{} held against ray-traced truth in each of them", count,
                                         count == 1 ? "" : "s"),
                     .body = body,
                     .data = std::move(data),
                     .pictures = nullptr});
}

} // namespace gnomon::app
