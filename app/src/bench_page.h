// SPDX-License-Identifier: Apache-2.0
// The page of a bench's report.
#pragma once

#include "result_json.h"

#include <string>

namespace gnomon::app {

/// The page of a bench's JSON, made like comparePage().
[[nodiscard]] std::string benchPage(const Json& result);

} // namespace gnomon::app
