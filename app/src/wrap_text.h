// SPDX-License-Identifier: Apache-2.0
// Text for a terminal of 100 columns.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace gnomon::app {

inline constexpr std::size_t kColumns = 100;

/// `text` after `first`, broken between words into lines of at most kColumns; all lines but the first begin with
/// `hanging` blanks. Ends with a line end. A word that is longer than a line stays whole. Columns are counted in bytes.
[[nodiscard]] std::string wrapped(std::string_view first, std::string_view text, std::size_t hanging);
/// "  NAME   text", the text in column `column` or after two blanks, wrapped there.
[[nodiscard]] std::string entryText(std::string_view name, std::string_view text, std::size_t column);
/// "a b c", with another separator than a blank if one is given.
[[nodiscard]] std::string joined(std::span<const std::string_view> names, std::string_view separator = " ");

} // namespace gnomon::app
