// SPDX-License-Identifier: Apache-2.0
// The recorded counts of every pass of every view (recorded.json), and the changes since.
#pragma once

#include "bench_figures.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::counters {

/// Counts alone, without times.
using Techniques = std::vector<app::TechniqueFigures>;

struct Recorded {
    std::string driver; // that counted
    std::map<std::string, Techniques> views;
};

/// Throws where there is no such file or it is no record.
[[nodiscard]] Recorded readRecorded(const std::string& file);
/// A line for each pass, so that changes are seen in a diff. Views in the order of `order`; others are left out.
[[nodiscard]] std::string recordedText(const Recorded& recorded, const std::vector<std::string>& order);

/// A line for each count that is another one, grown or shrunk, and for each technique that only one of them has.
[[nodiscard]] std::vector<std::string> changes(const Techniques& recorded, const Techniques& now);

} // namespace gnomon::counters
