// SPDX-License-Identifier: Apache-2.0
#include "compare_folder.h"

#include "app/visual.h"
#include "compare_json.h"
#include "compare_text.h"
#include "report_plots.h"

#include "image/image_io.h"
#include "lab/report.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace gnomon::app {
namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The files of the report whose result this is; none when it is none.
std::vector<std::string> filesOfReport(const fs::path& result)
{
    constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 28U; // far more than a result has
    std::error_code error;
    if (!fs::is_regular_file(result, error) || fs::file_size(result, error) > kMaxBytes || error) {
        return {};
    }
    std::ifstream in(result, std::ios::binary);
    const Json json = Json::parse(in, nullptr, false);
    if (!json.is_object() || !json.contains("report_files") || !json["report_files"].is_array()) {
        return {};
    }
    std::vector<std::string> files;
    for (const Json& name : json["report_files"]) {
        if (name.is_string() && isReportFile(name.get<std::string>())) {
            files.push_back(name.get<std::string>());
        }
    }
    return files;
}

/// Absolute and without a slash at the end, so that it has a name and a parent.
fs::path folderPath(const fs::path& folder)
{
    const fs::path full = fs::absolute(folder).lexically_normal();
    return full.has_filename() || full == full.root_path() ? full : full.parent_path();
}

/// What was compared and how, for whoever opens the page a year later.
std::vector<std::pair<std::string, std::string>> facts(const CompareResult& result, const Shot& shot,
                                                       const Settings& settings)
{
    std::vector<std::pair<std::string, std::string>> made{
        {"scene", fmt::format("{} ({})", settings.scene, result.scene_hash)},
        {"camera", shot.camera},
        {"light", fmt::format("{}: {}", result.light().name, lightText(result.light()))}};
    if (result.sweep && result.sweep->plan.remakes_shot) {
        made.emplace_back("shown", fmt::format("scene, camera, light and the truth's picture at {}",
                                               placeText(result.sweep->plan, 0)));
    }
    if (result.path) {
        made.emplace_back("path", fmt::format("{}, frames {} to {}, {} per second; camera and light are of the first",
                                              result.path->name, result.path->frames.first, result.path->frames.last,
                                              settings.fps));
    }
    made.insert(made.end(),
                {{"size", fmt::format("{} x {} pixels", settings.size_px.x, settings.size_px.y)},
                 {"truth", truthText(result)},
                 {"pixels", countedText(result)},
                 {"device", fmt::format("{} ({})", result.device, result.driver)},
                 {"version", GNOMON_VERSION},
                 {"result", fmt::format("{}: every number, and the settings to repeat it", kReportResult)}});
    return made;
}

void writeTechnique(ReportFolder& folder, const CompareResult& result, std::size_t index, lab::Report& page)
{
    const ComparedTechnique& technique = result.techniques[index];
    const lab::Score& score = technique.score;
    const ImageF& truth = result.judged.truth.visibility.visibility;
    const ImageOf<lab::ErrorClass> nothing_counts(truth.width, truth.height, 1, lab::ErrorClass::left_out);
    lab::ReportTechnique shown;
    shown.name = technique.name;
    shown.mask_file = numbered(index, "mask.png");
    shown.error_file = numbered(index, "error.png");
    shown.class_file = numbered(index, "classes.png");
    const std::size_t density = densityShownBy(result, index);
    shown.density_file = numbered(density, "density.png");
    folder.write(shown.mask_file, maskAs16Bit(score.mask));
    folder.write(shown.error_file, lab::errorPicture(score.mask, truth, score.pixels.counted));
    folder.write(
        shown.class_file,
        lab::classPicture(score.classification ? score.classification->classes : nothing_counts, score.mask, truth));
    if (density == index) {
        folder.write(shown.density_file, lab::densityPicture(score.density.map));
    }
    page.techniques.push_back(shown);
}

/// First, middle and last frame of every technique, and curves over all frames.
void writePath(ReportFolder& folder, const CompareResult& result, lab::Report& page, const std::function<void()>& step)
{
    const PathResult& path = *result.path;
    const std::vector<std::string_view> moments = momentsOf(path.shown.size());
    for (std::size_t k = 0; k < moments.size(); ++k) {
        folder.write(pictureOf("truth", moments[k]), maskAs16Bit(path.truths[k]));
    }
    page.plots.push_back({kReportError, "Error of every technique over the frames."});
    if (path.frames.first != path.frames.last) {
        page.plots.push_back({kReportChange,
                              "How much the error of every technique changes from one frame to the next, "
                              "at the same points: level is steady, peaks are pops."});
    }
    for (std::size_t i = 0; i < result.techniques.size(); ++i) {
        const ComparedTechnique& technique = result.techniques[i];
        lab::ReportTechnique shown;
        shown.name = technique.name;
        for (std::size_t k = 0; k < moments.size(); ++k) {
            const lab::ShownFrame& frame = technique.path->shown[k];
            lab::ReportFrame pictures;
            pictures.name = fmt::format("frame {}", path.shown[k]);
            pictures.truth_file = pictureOf("truth", moments[k]);
            pictures.mask_file = numbered(i, pictureOf("mask", moments[k]));
            pictures.error_file = numbered(i, pictureOf("error", moments[k]));
            pictures.class_file = numbered(i, pictureOf("classes", moments[k]));
            folder.write(pictures.mask_file, maskAs16Bit(frame.mask));
            folder.write(pictures.error_file, lab::errorPicture(frame.mask, path.truths[k], frame.counted));
            folder.write(pictures.class_file, lab::classPicture(frame.classes, frame.mask, path.truths[k]));
            shown.frames.push_back(std::move(pictures));
        }
        page.techniques.push_back(std::move(shown));
        step();
    }
}

void addSweep(lab::Report& page, const SweepResult& sweep)
{
    const std::string& key = sweep.plan.key;
    page.table_caption = fmt::format("Every technique over {}.", key);
    if (sweep.plan.lines.size() == 1) {
        page.plots.push_back({kReportSweep, fmt::format("Error over {}, and where it comes from.", key)});
        return;
    }
    page.plots.push_back({kReportSweep, fmt::format("Error of every technique over {}.", key)});
    for (std::size_t i = 0; i < sweep.plan.lines.size(); ++i) {
        const std::string file = numbered(i, "sweep.svg");
        page.plots.push_back(
            {file, fmt::format("{}: where its error over {} comes from.", sweep.plan.lines[i].technique, key)});
    }
}

} // namespace

std::size_t densityShownBy(const CompareResult& result, std::size_t technique)
{
    const std::vector<float>& map = result.techniques[technique].score.density.map.values;
    const auto same =
        std::find_if(result.techniques.begin(), result.techniques.end(),
                     [&](const ComparedTechnique& other) { return other.score.density.map.values == map; });
    // Where a value is not a number, a map does not equal itself.
    return std::min(technique, static_cast<std::size_t>(same - result.techniques.begin()));
}

void forgetSharedFiles(CompareResult& result)
{
    for (std::size_t i = 0; i < result.techniques.size(); ++i) {
        if (densityShownBy(result, i) != i) {
            std::erase(result.report_files, numbered(i, "density.png"));
        }
    }
}

ReportFolder::ReportFolder(fs::path folder, std::vector<std::string> files)
    : path_(folderPath(folder)), files_(std::move(files))
{
    const std::string what = "writing a report to " + folder.string();
    if (fs::exists(path_)) {
        if (!fs::is_directory(path_)) {
            throw Error(what, "it is not a folder", "name another, or remove it");
        }
        earlier_ = filesOfReport(path_ / kReportResult);
        requireNoForeignFile(what);
    } else if (!fs::is_directory(path_.parent_path())) {
        throw Error(what, "there is no folder " + path_.parent_path().string());
    }
    requireWritable((fs::exists(path_) ? path_ : path_.parent_path()) / fmt::format(".{}.tmp", ::getpid()));
}

void ReportFolder::requireNoForeignFile(const std::string& what) const
{
    for (const std::string& name : files_) {
        const fs::file_status status = fs::symlink_status(path_ / name);
        if (fs::exists(status) && !(contains(earlier_, name) && fs::is_regular_file(status))) {
            throw Error(what, fmt::format("{} is there already and of no earlier report", name),
                        "name another folder, or move it away");
        }
    }
}

ReportFolder::~ReportFolder()
{
    if (!work_.empty()) {
        std::error_code ignored;
        fs::remove_all(work_, ignored);
    }
}

/// Beside the files that are to be replaced, or beside the folder that is to be: always on the same file system.
void ReportFolder::makeWorkFolder()
{
    const fs::path parent = fs::exists(path_) ? path_ : path_.parent_path();
    constexpr int kAttempts = 100;
    std::error_code error;
    for (int attempt = 0; attempt < kAttempts && !error; ++attempt) {
        const fs::path work = parent / fmt::format(".gnomon-report.{}-{}.tmp", ::getpid(), attempt);
        if (fs::create_directory(work, error)) {
            work_ = work;
            return;
        }
    }
    throw Error("making a folder in " + parent.string(), error ? error.message() : "every name is taken");
}

fs::path ReportFolder::fileFor(const std::string& name)
{
    assert(contains(files_, name));
    if (work_.empty()) {
        makeWorkFolder();
    }
    return work_ / name;
}

void ReportFolder::write(const std::string& name, const Image8& picture)
{
    writePng(fileFor(name), picture);
}

void ReportFolder::write(const std::string& name, const Image16& mask)
{
    writePng(fileFor(name), mask);
}

void ReportFolder::write(const std::string& name, std::string_view bytes)
{
    writeFile(fileFor(name), bytes);
}

std::optional<std::string> ReportFolder::writePlots()
{
    return drawPlots(fileFor(kReportResult), work_);
}

void ReportFolder::keep()
{
    const auto move = [](const fs::path& from, const fs::path& to) {
        std::error_code error;
        fs::rename(from, to, error);
        if (error) {
            throw Error("writing " + to.string(), error.message());
        }
    };
    if (work_.parent_path() != path_) {
        move(work_, path_);
        work_.clear();
        return;
    }
    std::vector<std::string> written;
    for (const std::string& name : files_) {
        if (fs::exists(work_ / name)) {
            move(work_ / name, path_ / name);
            written.push_back(name);
        }
    }
    std::error_code ignored;
    for (const std::string& name : earlier_) {
        if (!contains(written, name) && fs::is_regular_file(fs::symlink_status(path_ / name, ignored))) {
            fs::remove(path_ / name, ignored);
        }
    }
}

std::optional<std::string> writeReport(ReportFolder& folder, const CompareResult& result, const Shot& shot,
                                       const Settings& settings, Json& json, const std::function<void()>& step)
{
    lab::Report page;
    page.title = fmt::format("Shadows of {} against ray-traced truth", settings.scene);
    page.truth_file = kReportTruth;
    page.facts = facts(result, shot, settings);
    if (!result.path) {
        folder.write(page.truth_file, maskAs16Bit(result.judged.truth.visibility.visibility));
    }
    TextTable table;
    if (result.path) {
        table = compareTable(result, false);
        page.table_caption = "Best first; means over the frames.";
        writePath(folder, result, page, step);
    } else if (result.sweep) {
        table = sweepTable(*result.sweep);
        addSweep(page, *result.sweep);
    } else {
        table = compareTable(result, false);
        for (std::size_t i = 0; i < result.techniques.size(); ++i) {
            writeTechnique(folder, result, i, page);
            step();
        }
    }
    page.columns = table.columns;
    page.column_meanings = meaningsOf(table);
    page.rows = table.rows;
    folder.write(kReportResult, jsonText(json));
    std::optional<std::string> no_plots;
    if (!page.plots.empty()) {
        no_plots = folder.writePlots();
    }
    if (no_plots) {
        page.plots.clear();
        json["notes"].push_back(*no_plots);
        Json::array_t& files = json["report_files"].get_ref<Json::array_t&>();
        std::erase_if(files, [](const Json& name) { return name.get_ref<const std::string&>().ends_with(".svg"); });
        folder.write(kReportResult, jsonText(json));
    }
    page.notes = json["notes"];
    folder.write(kReportPage, lab::reportPage(page));
    folder.keep();
    return no_plots;
}

} // namespace gnomon::app
