// SPDX-License-Identifier: Apache-2.0
#include "compare_folder.h"

#include "compare_text.h"

#include "image/image_io.h"
#include "lab/report.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace gnomon::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "index.html";
constexpr const char* kResult = "result.json";
constexpr std::array<std::string_view, 5> kNumbered{"mask.png", "error.png", "classes.png", "density.png", "sweep.svg"};

std::string numbered(std::size_t index, std::string_view what)
{
    return fmt::format("{:02}_{}", index + 1, what);
}

/// Whether it is a name that numbered() makes.
bool isNumbered(const std::string& name)
{
    const std::size_t digits = std::min(name.find('_'), name.size());
    return digits >= 2 && digits < name.size() &&
           std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(digits),
                       [](unsigned char c) { return std::isdigit(c) != 0; }) &&
           std::find(kNumbered.begin(), kNumbered.end(), name.substr(digits + 1)) != kNumbered.end();
}

/// What was compared and how, for whoever opens the page a year later.
std::vector<std::pair<std::string, std::string>> facts(const CompareResult& result, const Shot& shot,
                                                       const Settings& settings)
{
    return {{"scene", fmt::format("{} ({})", settings.scene, result.scene_hash)},
            {"camera", shot.camera},
            {"light", fmt::format("{}: {}", result.light.name, lightText(result.light))},
            {"size", fmt::format("{} x {} pixels", settings.size_px.x, settings.size_px.y)},
            {"truth", truthText(result)},
            {"pixels", pixelsText(result.pixels)},
            {"device", fmt::format("{} ({})", result.device, result.driver)},
            {"version", GNOMON_VERSION},
            {"result", fmt::format("{}: every number, and the settings to repeat it", kResult)}};
}

void writeTechnique(ReportFolder& folder, const CompareResult& result, std::size_t index, lab::Report& page)
{
    const ComparedTechnique& technique = result.techniques[index];
    const lab::Score& score = technique.score;
    const ImageF& truth = result.truth.visibility.visibility;
    const ImageOf<lab::ErrorClass> nothing_counts(truth.width, truth.height, 1, lab::ErrorClass::left_out);
    lab::ReportTechnique shown;
    shown.name = technique.name;
    shown.mask_file = numbered(index, "mask.png");
    shown.error_file = numbered(index, "error.png");
    shown.class_file = numbered(index, "classes.png");
    shown.density_file = numbered(index, "density.png");
    folder.write(shown.mask_file, lab::greyPicture(score.mask));
    folder.write(shown.error_file, lab::errorPicture(score.mask, truth, score.pixels.counted));
    folder.write(
        shown.class_file,
        lab::classPicture(score.classification ? score.classification->classes : nothing_counts, score.mask, truth));
    folder.write(shown.density_file, lab::densityPicture(score.density.map));
    page.techniques.push_back(shown);
}

void writeSweep(ReportFolder& folder, const SweepResult& sweep, const Settings& settings, lab::Report& page,
                const std::function<void()>& step)
{
    const std::string& key = sweep.plan.key;
    page.table_caption = fmt::format("Every technique over {}.", key);
    if (sweep.plan.lines.size() == 1) {
        folder.write("sweep.svg", lab::plotSvg(sweepClassPlot(sweep, 0, settings.scene)));
        page.plots.push_back({"sweep.svg", fmt::format("Error over {}, and where it comes from.", key)});
        step();
        return;
    }
    folder.write("sweep.svg", lab::plotSvg(sweepPlot(sweep, settings.scene)));
    page.plots.push_back({"sweep.svg", fmt::format("Error of every technique over {}.", key)});
    for (std::size_t i = 0; i < sweep.plan.lines.size(); ++i) {
        const std::string file = numbered(i, "sweep.svg");
        folder.write(file, lab::plotSvg(sweepClassPlot(sweep, i, settings.scene)));
        page.plots.push_back(
            {file, fmt::format("{}: where its error over {} comes from.", sweep.plan.lines[i].technique, key)});
        step();
    }
}

} // namespace

ReportFolder::ReportFolder(fs::path folder) : path_(std::move(folder))
{
    const std::string what = "writing a report to " + path_.string();
    if (fs::exists(path_)) {
        if (!fs::is_directory(path_)) {
            throw Error(what, "it is not a folder", "name another, or remove it");
        }
        requireWritable(path_ / kResult);
        had_report_ = fs::exists(path_ / kPage) && fs::exists(path_ / kResult);
        return;
    }
    // A name that ends in a slash is the folder before it.
    const fs::path full = fs::absolute(path_).lexically_normal();
    const fs::path parent = full.has_filename() ? full.parent_path() : full.parent_path().parent_path();
    if (!fs::is_directory(parent)) {
        throw Error(what, "there is no folder " + parent.string());
    }
    requireWritable(parent / kResult);
}

ReportFolder::~ReportFolder()
{
    if (!created_) {
        return;
    }
    std::error_code ignored;
    for (const std::string& name : written_) {
        fs::remove(path_ / name, ignored);
    }
    fs::remove(path_, ignored); // only while it is empty
}

fs::path ReportFolder::fileFor(const std::string& name)
{
    if (!fs::exists(path_)) {
        std::error_code error;
        if (!fs::create_directory(path_, error) && error) {
            throw Error("making folder " + path_.string(), error.message());
        }
        created_ = true;
    }
    written_.push_back(name);
    return path_ / name;
}

void ReportFolder::write(const std::string& name, const Image8& picture)
{
    writePng(fileFor(name), picture);
}

void ReportFolder::write(const std::string& name, std::string_view bytes)
{
    writeFile(fileFor(name), bytes);
}

void ReportFolder::keep()
{
    created_ = false;
    if (!had_report_) {
        return;
    }
    std::error_code ignored;
    std::vector<fs::path> stale;
    for (const auto& entry : fs::directory_iterator(path_, ignored)) {
        const std::string name = entry.path().filename().string();
        const bool ours = isNumbered(name) || name == "sweep.svg";
        if (ours && std::find(written_.begin(), written_.end(), name) == written_.end()) {
            stale.push_back(entry.path());
        }
    }
    for (const fs::path& file : stale) {
        fs::remove(file, ignored);
    }
}

void writeReport(ReportFolder& folder, const CompareResult& result, const Shot& shot, const Settings& settings,
                 std::string_view json, const std::function<void()>& step)
{
    lab::Report page;
    page.title = fmt::format("Shadows of {} against ray-traced truth", settings.scene);
    page.truth_file = "truth.png";
    page.facts = facts(result, shot, settings);
    page.notes = result.notes;
    folder.write(page.truth_file, lab::greyPicture(result.truth.visibility.visibility));
    TextTable table;
    if (result.sweep) {
        table = sweepTable(*result.sweep);
        writeSweep(folder, *result.sweep, settings, page, step);
    } else {
        table = compareTable(result, false);
        for (std::size_t i = 0; i < result.techniques.size(); ++i) {
            writeTechnique(folder, result, i, page);
            step();
        }
    }
    page.columns = table.columns;
    page.rows = table.rows;
    folder.write(kResult, json);
    folder.write(kPage, lab::reportPage(page));
    folder.keep();
}

} // namespace gnomon::app
