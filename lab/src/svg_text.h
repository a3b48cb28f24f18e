// SPDX-License-Identifier: Apache-2.0
// Numbers and words in SVG.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gnomon::lab {

/// A coordinate in pixels, to a hundredth, without needless zeros; whatever the locale.
[[nodiscard]] std::string svgNumber(double value);

/// Any bytes as XML text or attribute: valid UTF-8 (invalid bytes, and characters that XML forbids, become U+FFFD),
/// with & < > " ' escaped, cut to `max_columns` with an ellipsis.
[[nodiscard]] std::string svgText(std::string_view text, std::size_t max_columns);

/// About how many letters wide a text is, for layout: wide scripts count two for each character.
[[nodiscard]] std::size_t columnsOf(std::string_view text);

} // namespace gnomon::lab
