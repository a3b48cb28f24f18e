// SPDX-License-Identifier: Apache-2.0
// One bench compared with an earlier one: which counters have grown, and which times by more than their spread.
#pragma once

#include "bench_figures.h"
#include "result_json.h"

#include <string>
#include <vector>

namespace gnomon::app {

/// Throws Error where the runs cannot be compared: `head`, a result or its beginning, has another scene, view, light or
/// picture, or `techniques` and the earlier run have none in common.
void requireComparable(const BenchFigures& earlier, const Json& head, const std::vector<std::string>& techniques);

/// {"file", "device", "counters": {"grew", "shrank"}, "times": {"judged", "grew", "shrank"}, "only_before",
/// "only_now"}. Counters are compared exactly; a pass that a run lacks has counted 0 there. Times are divided by the
/// frame without shadows of their own run. They have changed where their medians lie farther apart than either run's
/// interquartile range. One sample has no range: then `judged` is false.
[[nodiscard]] Json againstJson(const BenchFigures& earlier, const BenchFigures& now);
/// The result of againstJson() as tables of what grew.
[[nodiscard]] std::string againstText(const Json& against);
/// Throws Error where a counter grew.
void requireNoGrowth(const Json& against);

} // namespace gnomon::app
