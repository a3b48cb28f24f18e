// SPDX-License-Identifier: Apache-2.0
// From text to checked values.
#pragma once

#include "app/settings.h"

#include <optional>

namespace gnomon::app {

/// The whole text as a finite number, independent of the locale.
[[nodiscard]] std::optional<double> toNumber(std::string_view text);
[[nodiscard]] std::optional<std::int64_t> toInteger(std::string_view text);
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
/// Throws UsageError.
[[nodiscard]] SettingValue parseValue(const Setting& setting, std::string_view text);
/// What such a value is kept and shown as: numbers and flags in one way, however they were typed.
[[nodiscard]] std::string textOf(const Setting& setting, const SettingValue& value, std::string_view text);

/// Applies it, without a word in Settings::values.
void applyValue(Settings& settings, const Setting& setting, const SettingValue& value);

} // namespace gnomon::app
