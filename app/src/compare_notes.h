// SPDX-License-Identifier: Apache-2.0
// Sentences on what kept a number from being there, or from meaning what one would think.
#pragma once

#include "compare_result.h"
#include "result_json.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::app {

/// `json`: of `result`, but for the notes.
[[nodiscard]] std::vector<std::string> compareNotes(const CompareResult& result, const Json& json);
/// What to know of the numbers of these pixels, as a result has them, of which `rays` were traced: that there are none,
/// or of few of the pixels that see a surface; empty when one in twenty counts.
[[nodiscard]] std::string pixelsNote(const Json& pixels, std::uint64_t rays);

} // namespace gnomon::app
