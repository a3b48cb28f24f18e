// SPDX-License-Identifier: Apache-2.0
// The subcommands, one file each, and how they put out their results.
#pragma once

#include "app/settings.h"
#include "result_json.h"

#include <string_view>

namespace gnomon::app {

int runRender(const Settings& settings);
int runCompare(const Settings& settings);
int runMetrics(const Settings& settings);
int runPlan(const Settings& settings);
int runBench(const Settings& settings);
int runList(const Settings& settings);
int runGpus(const Settings& settings);
int runCalibrate(const Settings& settings);
int runView(const Settings& settings);
int runCompletion(const Settings& settings);
int runMan(const Settings& settings);

// Results in memory, as the JSON that is printed. Notices go to standard error and a report to its folder; nothing goes
// to standard output or to the file of --json.
[[nodiscard]] Json findByComparing(const Settings& settings);
[[nodiscard]] Json findByTiming(const Settings& settings); // bench

/// Writes to the file, or to stdout for "-" and "".
void writeResult(const std::string& file, std::string_view text);

} // namespace gnomon::app
