// SPDX-License-Identifier: Apache-2.0
// Comparing along a path: every technique and the truth at every frame.
#pragma once

#include "app/shot.h"
#include "compare_result.h"

#include <functional>
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

} // namespace gnomon::app
