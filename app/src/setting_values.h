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
/// "1 to 8 texels". Precondition: it has a range.
[[nodiscard]] std::string rangeText(const Setting& setting);
/// Throws UsageError.
[[nodiscard]] SettingValue parseValue(const Setting& setting, std::string_view text);
/// The text in which a value is kept and shown: numbers and flags in one form, however they were typed.
[[nodiscard]] std::string textOf(const Setting& setting, const SettingValue& value, std::string_view text);

/// Applies a value without noting it in Settings::values.
void applyValue(Settings& settings, const Setting& setting, const SettingValue& value);

} // namespace gnomon::app
