// SPDX-License-Identifier: Apache-2.0
// A comparison's results (compare_result.h): along a path, as JSON, and with notes. The table on the terminal and the
// report's page are made from the JSON alone.
#pragma once

#include "compare_result.h"
#include "result_json.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// How often comparePath() calls `step`.
[[nodiscard]] std::uint64_t pathSteps(const Settings& settings, const std::vector<Settings>& techniques);
/// Moves `shot` over --frames, compares every technique with the truth of each, and fills `result`: techniques, best
/// first, PathResult, and facts of the truth. Afterwards the shot is back at the first frame, of which
/// CompareResult::judged is. Techniques walk in lab::timingGroups(); each group meets the truths anew, through the
/// cache. Pictures are kept for a report only. Throws as judge() does.
void comparePath(const host::SceneOnGpu& scene, Shot& shot, const Settings& settings,
                 const std::vector<Settings>& techniques, CompareResult& result, const std::function<void()>& step);

/// The JSON without the names of a report's files, which writeReport() adds.
[[nodiscard]] Json compareJson(const CompareResult& result, const Shot& shot, const Settings& settings);

/// {"kind", "requested", "samples", ...}; `standard_error` is absent when no pixel counts.
[[nodiscard]] Json truthJson(const TruthFacts& truth, const std::optional<double>& standard_error);
/// {"counted", "left_out", "left_out_by_reason"}.
[[nodiscard]] Json pixelsJson(const lab::PixelCounts& pixels);

/// The notes of a comparison. `json` is that of `result`, without the notes.
[[nodiscard]] std::vector<std::string> compareNotes(const CompareResult& result, const Json& json);
/// A note where no pixel counts, or fewer than one in twenty of those that see a surface; else empty. `pixels` is as a
/// result has it; `rays` were traced.
[[nodiscard]] std::string pixelsNote(const Json& pixels, std::uint64_t rays);

} // namespace gnomon::app
