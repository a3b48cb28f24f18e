// SPDX-License-Identifier: Apache-2.0
// The folder of a comparison's report: pictures, page and result.
#pragma once

#include "compare_result.h"
#include "files/temporary.h"
#include "image/image.h"
#include "report_names.h"
#include "result_json.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// Files are written into a folder of their own; keep() puts them all in their place. Until then neither a folder that
/// is there nor its report changes, and what was written goes away if keep() is not called.
class ReportFolder {
public:
    /// `files`: what will be written. Throws Error, before an hour's work, when the folder can be neither used nor
    /// made, or holds one of these files and it is not of an earlier report, which lists its files in result.json.
    ReportFolder(const std::filesystem::path& folder, std::vector<std::string> files);
    ~ReportFolder();
    ReportFolder(const ReportFolder&) = delete;
    ReportFolder& operator=(const ReportFolder&) = delete;

    /// `name` is one of the files; not all need be written.
    void write(const std::string& name, const Image8& picture);
    void write(const std::string& name, const Image16& mask);
    void write(const std::string& name, std::string_view bytes);
    /// The names of the files written so far, and of the page and result.json.
    [[nodiscard]] std::vector<std::string> listed() const;
    /// Puts the written files in their place, and removes those that only the earlier report had.
    void keep();

private:
    void takeStock();
    void makeWorkFolder();
    void moveFiles();
    [[nodiscard]] std::filesystem::path fileFor(const std::string& name);

    std::filesystem::path path_;
    std::vector<std::string> files_;
    std::vector<std::string> earlier_; // files of the report that is there
    std::optional<Temporary> work_;    // where files are written, once the first one is
};

/// Pictures of every technique, the page, result.json. `json` (of `result`) gains "pictures" and "report_files". `step`
/// is called after every technique and may throw.
void writeReport(ReportFolder& folder, const CompareResult& result, Json& json, const std::function<void()>& step);

} // namespace gnomon::app
