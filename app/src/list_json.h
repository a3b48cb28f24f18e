// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "result_json.h"

#include <string_view>

namespace gnomon::app {

inline constexpr std::string_view kTechniqueGrammar =
    "A technique is values of the choices and KEY=VALUE of technique settings, joined by + in any order; what is left "
    "out has its default: hard, pcf+pcf.kernel=5x5+map-size=1024. Lists of techniques have commas between.";

/// All that `list` knows: {"version", "choices", "technique_grammar", "refused", "settings", "presets", "worlds"}. With
/// a name that `list` has, the parts of these that concern it, with "name" and without empty lists.
[[nodiscard]] Json listJson(std::string_view name);

} // namespace gnomon::app
