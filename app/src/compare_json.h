// SPDX-License-Identifier: Apache-2.0
// A comparison as JSON, with all that is needed to repeat it. The table on the terminal and the report's page are made
// from it alone.
#pragma once

#include "compare_result.h"
#include "result_json.h"

#include <optional>
#include <string>

namespace gnomon::app {

/// The JSON without the names of a report's files, which writeReport() adds.
[[nodiscard]] Json compareJson(const CompareResult& result, const Shot& shot, const Settings& settings);

/// {"kind", "requested", "samples", ...}; `standard_error` is absent when no pixel counts.
[[nodiscard]] Json truthJson(const TruthFacts& truth, const std::optional<double>& standard_error);
/// {"counted", "left_out", "left_out_by_reason"}.
[[nodiscard]] Json pixelsJson(const lab::PixelCounts& pixels);

} // namespace gnomon::app
