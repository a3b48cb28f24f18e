// SPDX-License-Identifier: Apache-2.0
// A comparison as JSON, with all that it takes to repeat it.
#pragma once

#include "compare_result.h"
#include "result_json.h"

namespace gnomon::app {

[[nodiscard]] Json compareJson(const CompareResult& result, const Shot& shot, const Settings& settings);

/// As text; bytes that are no UTF-8 (of a file's name, say) are replaced.
[[nodiscard]] std::string jsonText(const Json& json);

} // namespace gnomon::app
