// SPDX-License-Identifier: Apache-2.0
// The folder of a comparison's report: pictures, page and result.
#pragma once

#include "compare_result.h"
#include "image/image.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// Made when the first file is written. Until keep() is called, a folder that this run made goes away with all that
/// this run wrote into it; one that was there before keeps its files, some of them perhaps new.
class ReportFolder {
public:
    /// Throws Error, before an hour's work, when the folder can be neither used nor made.
    explicit ReportFolder(std::filesystem::path folder);
    ~ReportFolder();
    ReportFolder(const ReportFolder&) = delete;
    ReportFolder& operator=(const ReportFolder&) = delete;

    void write(const std::string& name, const Image8& picture);
    void write(const std::string& name, std::string_view bytes);
    /// Removes what an earlier, longer report left here: numbered pictures that this one did not write.
    void keep();

private:
    [[nodiscard]] std::filesystem::path fileFor(const std::string& name);

    std::filesystem::path path_;
    bool created_ = false;
    bool had_report_ = false;
    std::vector<std::string> written_;
};

/// Pictures of every technique, the page, result.json (`json`). `step` is called after every technique and may throw.
void writeReport(ReportFolder& folder, const CompareResult& result, const Shot& shot, const Settings& settings,
                 std::string_view json, const std::function<void()>& step);

} // namespace gnomon::app
