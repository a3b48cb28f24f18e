// SPDX-License-Identifier: Apache-2.0
// One setting takes many values, and every technique is compared with the same truth at each: error over value. Where
// the setting is not the technique's, the shot and its truth are made anew for each value.
#pragma once

#include "app/settings.h"
#include "compare_judged.h"
#include "lab/compare.h"
#include "result_json.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// The plan of a sweep, made and checked before anything is drawn.
struct SweepPlan {
    struct Line {
        std::string technique;        // without the setting that is swept
        std::vector<Settings> points; // one for each of `values`
    };
    std::string key;
    std::string unit; // empty: none
    bool logarithmic = false;
    bool remakes_shot = false;  // no setting of a technique: camera, light, truth and time follow
    std::vector<double> values; // ascending or descending, as asked for
    std::vector<Line> lines;
    bool ends_automatic_bias = false;  // sweeping turns off a technique's automatic bias
    std::vector<std::string> left_out; // techniques on which the setting has no effect, a sentence each
};
/// `sweep` is as --sweep makes it: a number of compare's, two steps or more. Whole numbers are rounded (to multiples,
/// where the setting takes only those) and taken once each. Throws UsageError when the setting has no effect on any
/// technique, or is all that tells two of them apart.
[[nodiscard]] SweepPlan planSweep(const Sweep& sweep, const std::vector<Settings>& techniques);
/// `settings` with one of the plan's values.
[[nodiscard]] Settings settingsAt(const SweepPlan& plan, std::size_t value, const Settings& settings);
/// "sun-angle=0.5"
[[nodiscard]] std::string placeText(const std::string& key, double value);

struct SweepResult {
    struct Point {
        std::optional<lab::ErrorNumbers> error;  // absent when no pixel counts
        std::optional<lab::ClassErrors> classes; // absent when no pixel counts
        Outcome outcome;
    };
    /// The same for all techniques.
    struct Place {
        TruthFacts truth;
        std::optional<double> standard_error; // the truth's standard error; absent when no pixel counts
        lab::PixelCounts pixels;
    };
    SweepPlan plan;
    std::vector<std::vector<Point>> points; // by line and value
    std::vector<Place> places;              // by value; the first one alone where the shot is not made anew
};
/// The light and truth at a value, by its index. Called once for each in order; a result must hold until the next call.
using JudgedAt = std::function<const Judged&(std::size_t value)>;
/// `step` is called after every technique drawn and may throw to stop.
[[nodiscard]] SweepResult runSweep(const host::SceneOnGpu& scene, SweepPlan plan, const JudgedAt& judged_at,
                                   const std::function<void()>& step);

/// {"key", "unit", "values", "class_colours", "results": [{"technique", "rmse", ...}]}, each list as long as the
/// values.
[[nodiscard]] Json sweepJson(const SweepResult& result);

} // namespace gnomon::app
