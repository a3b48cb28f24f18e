// SPDX-License-Identifier: Apache-2.0
// The pages of reports, and a bench's tables on a terminal, which are the same.
#pragma once

#include "result_json.h"

#include <cstdint>
#include <string>

namespace gnomon::app {

/// HTML in UTF-8 with all its pictures and scripts: a browser loads nothing else. It is made of the comparison's JSON
/// and of `pictures` (pagePictures()), which may be null. Every text in it is escaped.
[[nodiscard]] std::string comparePage(const Json& result, const Json& pictures);

/// The colours of pictures by their meaning: scales from end to end, and classes.
[[nodiscard]] Json pageLegends();

/// A bench's JSON in tables for a terminal. `map_side`: of its largest map.
[[nodiscard]] std::string benchText(const Json& result, std::uint32_t map_side);
/// The page of a bench's JSON, made like comparePage().
[[nodiscard]] std::string benchPage(const Json& result);

} // namespace gnomon::app
