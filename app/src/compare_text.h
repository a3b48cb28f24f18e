// SPDX-License-Identifier: Apache-2.0
// A comparison in words and tables, for the terminal and for the page. All of it is made from the comparison's JSON.
#pragma once

#include "compare_table.h"
#include "result_json.h"

#include <string>

namespace gnomon::app {

/// A row for each technique, best first; for a sweep, one for each technique and value. `short_names` leaves out the
/// parts that all techniques have.
[[nodiscard]] TextTable compareTable(const Json& result, bool short_names);
/// "area, 64 rays per pixel, standard error 0.0041; 2.1 million rays in 3.2 s (0.7 million/s)".
[[nodiscard]] std::string truthText(const Json& result);
/// "orbit, frames 0 to 59". Precondition: the result has a path.
[[nodiscard]] std::string framesText(const Json& result);
/// pixelsText() of the result, or where a sweep's numbers are.
[[nodiscard]] std::string countedText(const Json& result);
/// "12000 counted; left out: 300 background, 20 facing away". `pixels`: of a result.
[[nodiscard]] std::string pixelsText(const Json& pixels);
/// "directional, direction 0.6,-0.8,0, 0.53 degrees wide". `light`: the result's light_source.
[[nodiscard]] std::string lightText(const Json& light);
/// The whole comparison for a terminal.
[[nodiscard]] std::string compareText(const Json& result);

} // namespace gnomon::app
