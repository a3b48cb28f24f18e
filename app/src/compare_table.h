// SPDX-License-Identifier: Apache-2.0
// Tables of techniques as text.
#pragma once

#include "result_json.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// The first column is flush left, the others flush right.
struct TextTable {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows; // each as long as `columns`
    std::vector<std::string> meanings{};        // none, or as `columns`: a sentence without its end; empty where
                                                // the name says it
};
[[nodiscard]] std::string tableText(const TextTable& table);

/// Columns of a terminal that a table fits in.
inline constexpr std::size_t kTableWidth = 120;
/// tableText(), but where a line would be longer than kTableWidth the names of the first column are numbered and stand
/// below the table.
[[nodiscard]] std::string fittedTableText(const TextTable& table);

/// The text of a cell without a number.
inline constexpr std::string_view kNoNumber = "-";
[[nodiscard]] std::string cell(const std::optional<double>& value, int decimals);

/// "technique" of each of a result's rows.
[[nodiscard]] std::vector<std::string> techniqueNames(const Json& rows);
/// The parts after the first of "pcf+map-size=64+pcf.kernel=3x3" that all techniques have, "+" between; empty with
/// fewer than two techniques.
[[nodiscard]] std::string commonParts(const std::vector<std::string>& techniques);
/// The part that says how techniques blur, if all of them that blur say the same: "blur.path=compute"; else empty.
[[nodiscard]] std::string commonBlurPath(const std::vector<std::string>& techniques);
/// The names without commonParts() and commonBlurPath().
[[nodiscard]] std::vector<std::string> shortNames(std::vector<std::string> techniques);
/// `technique` less the parts of `parts`.
[[nodiscard]] std::string withoutParts(std::string_view technique, std::string_view parts);

} // namespace gnomon::app
