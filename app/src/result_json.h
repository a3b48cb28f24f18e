// SPDX-License-Identifier: Apache-2.0
// Pieces of JSON that several subcommands share.
#pragma once

#include "app/settings.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace gnomon::app {

using Json = nlohmann::ordered_json;

/// Every setting that has a value and is one of the subcommand's, typed, in the table's order; so a preset. What is
/// written where is not among them.
[[nodiscard]] Json settingsJson(const Settings& settings, std::uint32_t subcommand);
/// {"partition": "single", ...}
[[nodiscard]] Json choicesJson(const Technique& technique);
/// The number that `pointer` leads to; nothing where there is none.
[[nodiscard]] std::optional<double> numberAt(const Json& json, const char* pointer);
/// The text that `pointer` leads to. Precondition: there is one.
[[nodiscard]] const std::string& textAt(const Json& json, const char* pointer);

/// One setting as `list` shows it.
[[nodiscard]] Json settingJson(const Setting& setting);
/// As it is written; what is no UTF-8, such as some names of files, has U+FFFD in its place.
[[nodiscard]] std::string jsonText(const Json& json);

} // namespace gnomon::app
