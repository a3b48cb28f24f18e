// SPDX-License-Identifier: Apache-2.0
// Sentences that say why a number is missing, or why it does not mean what one would think.
#pragma once

#include "compare_result.h"
#include "result_json.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::app {

/// The notes of a comparison. `json` is that of `result`, without the notes.
[[nodiscard]] std::vector<std::string> compareNotes(const CompareResult& result, const Json& json);
/// A note where no pixel counts, or fewer than one in twenty of those that see a surface; else empty. `pixels` is as a
/// result has it; `rays` were traced.
[[nodiscard]] std::string pixelsNote(const Json& pixels, std::uint64_t rays);

} // namespace gnomon::app
