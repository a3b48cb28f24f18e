// SPDX-License-Identifier: Apache-2.0
// Pieces of JSON that several subcommands share.
#pragma once

#include "app/settings.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace gnomon::app {

using Json = nlohmann::ordered_json;

/// Every setting of the subcommand that has a value, typed, in the table's order, so that it is a preset. Settings that
/// say which files are written are left out.
[[nodiscard]] Json settingsJson(const Settings& settings, std::uint32_t subcommand);
/// {"partition": "single", ...}
[[nodiscard]] Json choicesJson(const Technique& technique);
/// The number that `pointer` leads to; nothing where there is none.
[[nodiscard]] std::optional<double> numberAt(const Json& json, const char* pointer);
/// The text that `pointer` leads to. Precondition: there is one.
[[nodiscard]] const std::string& textAt(const Json& json, const char* pointer);

/// One setting as `list` shows it.
[[nodiscard]] Json settingJson(const Setting& setting);
/// The JSON as text. U+FFFD replaces bytes that are no UTF-8, such as in some names of files.
[[nodiscard]] std::string jsonText(const Json& json);

} // namespace gnomon::app
