// SPDX-License-Identifier: Apache-2.0
#include "compare_folder.h"

#include "app/visual.h"
#include "compare_steps.h"
#include "report_pages.h"
#include "report_pictures.h"

#include "files/files.h"
#include "image/image_io.h"
#include "lab/report.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <system_error>

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
    constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 28U; // far more than a result has
    Json json;
    try {
        json = Json::parse(readWholeFile(result, kMaxBytes), nullptr, false);
    } catch (const Error&) {
        return {};
    }
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

/// Techniques that render the same map have the same picture of texel density, which is written once: the place of the
/// first of them.
std::size_t densityShownBy(const CompareResult& result, std::size_t technique)
{
    const std::vector<float>& map = result.techniques[technique].score.density.map.values;
    const auto same =
        std::find_if(result.techniques.begin(), result.techniques.end(),
                     [&](const ComparedTechnique& other) { return other.score.density.map.values == map; });
    // Where a value is not a number, a map does not equal itself.
    return std::min(technique, static_cast<std::size_t>(same - result.techniques.begin()));
}

/// The truth of every frame that is shown.
void writeTruths(ReportFolder& folder, const CompareResult& result)
{
    if (!result.path) {
        folder.write(kReportTruth, maskAs16Bit(result.judged.truth.visibility.visibility));
        return;
    }
    const std::vector<std::string_view> moments = momentsOf(result.path->shown.size());
    for (std::size_t i = 0; i < moments.size(); ++i) {
        folder.write(pictureOf("truth", moments[i]), maskAs16Bit(result.path->truths[i]));
    }
}

/// The pictures of a technique; their names, by what they show, for each frame that is shown.
Json writePictures(ReportFolder& folder, const CompareResult& result, std::size_t index)
{
    const ComparedTechnique& technique = result.techniques[index];
    const std::vector<std::string_view> moments = momentsOf(technique.shown.size());
    Json frames = Json::array();
    for (std::size_t i = 0; i < moments.size(); ++i) {
        const lab::ShownFrame& shown = technique.shown[i];
        const ImageF& truth = result.path ? result.path->truths[i] : result.judged.truth.visibility.visibility;
        Json names;
        if (result.path) {
            names["frame"] = result.path->shown[i];
        }
        names["truth"] = pictureOf("truth", moments[i]);
        const auto write = [&](const char* what, const auto& picture) {
            const std::string name = numbered(index, pictureOf(what, moments[i]));
            folder.write(name, picture);
            names[what] = name;
        };
        write("mask", maskAs16Bit(shown.mask));
        write("error", lab::errorPicture(shown.mask, truth, shown.counted));
        write("classes", lab::classPicture(shown.classes, shown.mask, truth));
        frames.push_back(std::move(names));
    }
    if (!result.path) {
        const std::size_t first = densityShownBy(result, index);
        const std::string name = numbered(first, "density.png");
        if (first == index) {
            folder.write(name, lab::densityPicture(technique.score.density.map));
        }
        frames[0]["density"] = name;
    }
    return frames;
}

} // namespace

ReportFolder::ReportFolder(const fs::path& folder, std::vector<std::string> files)
    : path_(folderPath(folder)), files_(std::move(files))
{
    const std::string what = "writing a report to " + folder.string();
    std::error_code error;
    const fs::file_type type = fs::status(path_, error).type();
    if (type == fs::file_type::none) {
        throw Error(what, error.message());
    }
    const bool is_there = type != fs::file_type::not_found;
    if (!is_there && fs::is_symlink(path_, error)) {
        throw Error(what, "it is a link to nothing", "name another, or remove it");
    }
    if (is_there && type != fs::file_type::directory) {
        throw Error(what, "it is not a folder", "name another, or remove it");
    }
    if (is_there) {
        const FolderLock lock(path_);
        takeStock();
    } else if (!fs::is_directory(path_.parent_path(), error)) {
        throw Error(what, "there is no folder " + path_.parent_path().string());
    }
    requireWritable((is_there ? path_ : path_.parent_path()) / ".gnomon-report");
}

/// Finds the files of an earlier report. Throws Error when the folder has any other file by a name that we write.
void ReportFolder::takeStock()
{
    earlier_ = filesOfReport(path_ / kReportResult);
    for (const std::string& name : files_) {
        std::error_code error;
        const fs::file_status status = fs::symlink_status(path_ / name, error);
        if (fs::exists(status) && !(contains(earlier_, name) && fs::is_regular_file(status))) {
            throw Error("writing a report to " + path_.string(),
                        fmt::format("{} is there already and of no earlier report", name),
                        "name another folder, or move it away");
        }
    }
}

ReportFolder::~ReportFolder() = default;

/// Beside the files that are to be replaced, or beside the folder that is to be: always on the same file system.
void ReportFolder::makeWorkFolder()
{
    std::error_code error;
    const fs::path parent = fs::exists(path_, error) ? path_ : path_.parent_path();
    work_.emplace(parent / "gnomon-report", Temporary::Kind::folder);
}

fs::path ReportFolder::fileFor(const std::string& name)
{
    assert(contains(files_, name));
    if (!work_) {
        makeWorkFolder();
    }
    return work_->path() / name;
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

std::vector<std::string> ReportFolder::listed() const
{
    std::vector<std::string> names = files_;
    std::erase_if(names, [&](const std::string& name) {
        return name != kReportPage && name != kReportResult && !fs::exists(work_->path() / name);
    });
    return names;
}

void ReportFolder::keep()
{
    if (work_->path().parent_path() == path_) {
        moveFiles();
        return;
    }
    const int error = work_->moveTo(path_);
    if (error == ENOTEMPTY || error == EEXIST) { // another process has made the folder meanwhile
        moveFiles();
    } else if (error != 0) {
        throw Error("writing " + path_.string(), std::generic_category().message(error));
    }
}

/// One process after the other, so that result, page and pictures are of one report.
void ReportFolder::moveFiles()
{
    const FolderLock lock(path_);
    takeStock();
    std::vector<std::string> written;
    std::error_code error;
    for (const std::string& name : files_) {
        if (fs::exists(work_->path() / name, error)) {
            fs::rename(work_->path() / name, path_ / name, error);
            if (error) {
                throw Error("writing " + (path_ / name).string(), error.message());
            }
            written.push_back(name);
        }
    }
    for (const std::string& name : earlier_) {
        if (!contains(written, name) && fs::is_regular_file(fs::symlink_status(path_ / name, error))) {
            fs::remove(path_ / name, error);
        }
    }
}

void writeReport(ReportFolder& folder, const CompareResult& result, Json& json, const std::function<void()>& step)
{
    writeTruths(folder, result);
    for (std::size_t i = 0; i < result.techniques.size(); ++i) {
        json["results"][i]["pictures"] = writePictures(folder, result, i);
        step();
    }
    json["report_files"] = folder.listed();
    const std::string text = jsonText(json);
    folder.write(kReportResult, text);
    folder.write(kReportPage, comparePage(Json::parse(text), pagePictures(result))); // the text is all UTF-8
    folder.keep();
}

} // namespace gnomon::app
