// SPDX-License-Identifier: Apache-2.0
// What subcommands find out, as the JSON that they print, for whoever wants it in memory. Notices go to standard error
// and a report to its folder as ever; nothing goes to standard output or to the file of --json.
#pragma once

#include "app/settings.h"
#include "result_json.h"

namespace gnomon::app {

[[nodiscard]] Json findByComparing(const Settings& settings);
[[nodiscard]] Json findByTiming(const Settings& settings); // bench

} // namespace gnomon::app
