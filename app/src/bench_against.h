// SPDX-License-Identifier: Apache-2.0
// One bench held against an earlier one: which counters have grown, and which times by more than they spread.
#pragma once

#include "bench_figures.h"
#include "result_json.h"

#include <string>
#include <vector>

namespace gnomon::app {

/// Throws Error where `head`, a result or its beginning, is of another scene, view, light or picture, or where
/// `techniques` and the earlier run have none in common: nothing could be said then.
void requireComparable(const BenchFigures& earlier, const Json& head, const std::vector<std::string>& techniques);

/// {"file", "device", "counters": {"grew", "shrank"}, "times": {"judged", "grew", "shrank"}, "only_before",
/// "only_now"}. Counters are compared exactly; a pass that one of the runs has not has counted nothing there. Times are
/// by the frame without shadows of their own run, and have changed where their medians lie farther apart than either
/// run's interquartile range. Of one sample there is none: then `judged` is false.
[[nodiscard]] Json againstJson(const BenchFigures& earlier, const BenchFigures& now);
/// That, as tables of what grew.
[[nodiscard]] std::string againstText(const Json& against);
/// Throws Error where a counter grew.
void requireNoGrowth(const Json& against);

} // namespace gnomon::app
