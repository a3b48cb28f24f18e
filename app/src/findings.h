// SPDX-License-Identifier: Apache-2.0
// The results of subcommands in memory, as the JSON that they print. Notices go to standard error and a report to its
// folder; nothing goes to standard output or to the file of --json.
#pragma once

#include "app/settings.h"
#include "result_json.h"

namespace gnomon::app {

[[nodiscard]] Json findByComparing(const Settings& settings);
[[nodiscard]] Json findByTiming(const Settings& settings); // bench

} // namespace gnomon::app
