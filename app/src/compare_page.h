// SPDX-License-Identifier: Apache-2.0
// The page of a comparison's report.
#pragma once

#include "result_json.h"

#include <string>

namespace gnomon::app {

/// HTML in UTF-8, without script or anything from elsewhere, which a browser shows from the folder that the report's
/// pictures lie in. Made of the comparison's JSON alone, with the files of its report; every text in it is escaped.
[[nodiscard]] std::string comparePage(const Json& result);

} // namespace gnomon::app
