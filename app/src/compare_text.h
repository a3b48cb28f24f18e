// SPDX-License-Identifier: Apache-2.0
// A comparison in words and tables, for the terminal and for the page.
#pragma once

#include "compare_result.h"
#include "compare_table.h"

#include <string>

namespace gnomon::app {

/// A row for each technique, best first. `short_names`: without what all techniques have in common.
[[nodiscard]] TextTable compareTable(const CompareResult& result, bool short_names);
/// "area, 64 rays per pixel, standard error 0.0041; 2.1 million rays in 3.2 s (0.7 million/s)".
[[nodiscard]] std::string truthText(const CompareResult& result);
/// "path:   orbit, frames 0 to 59".
[[nodiscard]] std::string pathText(const PathResult& path);
/// pixelsText() of the result, or where a sweep's numbers are.
[[nodiscard]] std::string countedText(const CompareResult& result);
/// "12000 counted; left out: 300 background, 20 facing away".
[[nodiscard]] std::string pixelsText(const lab::PixelCounts& pixels);
/// What to know of the numbers of these pixels, of which `rays` were traced: that there are none, or of few of the
/// pixels that see a surface; empty when one in twenty counts.
[[nodiscard]] std::string pixelsNote(const lab::PixelCounts& pixels, std::uint64_t rays);
/// "directional, direction 0.6,-0.8,0, 0.53 degrees wide".
[[nodiscard]] std::string lightText(const host::ShadedLight& light);
/// All of it for a terminal.
[[nodiscard]] std::string compareText(const CompareResult& result, const Shot& shot, const Settings& settings);

} // namespace gnomon::app
