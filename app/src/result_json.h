// SPDX-License-Identifier: Apache-2.0
// Pieces of JSON that several subcommands share.
#pragma once

#include "app/settings.h"

#include <nlohmann/json.hpp>

namespace gnomon::app {

using Json = nlohmann::ordered_json;

/// Every setting that has a value and is one of the subcommand's, typed, in the table's order.
[[nodiscard]] Json settingsJson(const Settings& settings, std::uint32_t subcommand);
/// {"partition": "single", ...}
[[nodiscard]] Json choicesJson(const Technique& technique);
/// One setting as `list` shows it.
[[nodiscard]] Json settingJson(const Setting& setting);

} // namespace gnomon::app
