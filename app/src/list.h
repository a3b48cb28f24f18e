// SPDX-License-Identifier: Apache-2.0
// `gnomon list`, which prints the topics (topics.h) and what is refused (list_rules.h).
#pragma once

#include "result_json.h"

#include <string_view>

namespace gnomon::app {

/// All that `list` knows: {"version", "choices", "technique_grammar", "refused", "settings", "presets", "worlds"}. With
/// a name that `list` has, the parts of these that concern it, with "name" and without empty lists.
[[nodiscard]] Json listJson(std::string_view name);

} // namespace gnomon::app
