// SPDX-License-Identifier: Apache-2.0
// The pages of reports.
#pragma once

#include "result_json.h"

#include <string>

namespace gnomon::app {

/// HTML in UTF-8 with all its pictures and scripts: a browser loads nothing else. It is made of the comparison's JSON
/// and of `pictures` (pagePictures()), which may be null. Every text in it is escaped.
[[nodiscard]] std::string comparePage(const Json& result, const Json& pictures);

/// The colours of pictures by their meaning: scales from end to end, and classes.
[[nodiscard]] Json pageLegends();

/// The page of a bench's JSON, made like comparePage().
[[nodiscard]] std::string benchPage(const Json& result);

} // namespace gnomon::app
