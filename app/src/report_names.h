// SPDX-License-Identifier: Apache-2.0
// The names of the files of a comparison's report.
#pragma once

#include "app/settings.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

inline constexpr const char* kReportPage = "index.html";
inline constexpr const char* kReportResult = "result.json";
inline constexpr const char* kReportTruth = "truth.png";

/// Names of a report's files, the page and result.json last. `shown` is the number of techniques, 0 for a sweep.
[[nodiscard]] std::vector<std::string> reportFiles(std::size_t shown);
/// Names of the files of a report along --path, with pictures of the first, the middle and the last frame.
[[nodiscard]] std::vector<std::string> pathReportFiles(std::size_t shown, const FrameRange& frames);
/// Whether a report could have a file of this name: names that are read from a file are not trusted.
[[nodiscard]] bool isReportFile(const std::string& name);

/// "03_mask.png" of the technique in row 2.
[[nodiscard]] std::string numbered(std::size_t index, std::string_view what);
/// The end of pictures' names before ".png", for each of a path's shown frames.
[[nodiscard]] std::vector<std::string_view> momentsOf(std::size_t shown_frames);
/// "mask_last.png".
[[nodiscard]] std::string pictureOf(std::string_view what, std::string_view moment);

} // namespace gnomon::app
