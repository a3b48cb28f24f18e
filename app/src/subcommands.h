// SPDX-License-Identifier: Apache-2.0
// The subcommands, one file each, and how they put out their results.
#pragma once

#include "app/settings.h"

#include <string_view>

namespace gnomon::app {

int runRender(const Settings& settings);
int runCompare(const Settings& settings);
int runMetrics(const Settings& settings);
int runPlan(const Settings& settings);
int runBench(const Settings& settings);
int runList(const Settings& settings);
int runGpus(const Settings& settings);
int runView(const Settings& settings);
int runCompletion(const Settings& settings);
int runMan(const Settings& settings);

/// Writes to the file, or to stdout for "-" and "".
void writeResult(const std::string& file, std::string_view text);

} // namespace gnomon::app
