// SPDX-License-Identifier: Apache-2.0
// The plots of a report are drawn by matplotlib, through tools/plot.py.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gnomon::app {

/// Draws the plots of a comparison whose JSON is in the file `result` into `folder`: sweep.svg and the like. The script
/// is part of the program; python3 and matplotlib are looked for. Nothing when all are drawn, else a sentence that says
/// why there are none.
[[nodiscard]] std::optional<std::string> drawPlots(const std::filesystem::path& result,
                                                   const std::filesystem::path& folder);

} // namespace gnomon::app
