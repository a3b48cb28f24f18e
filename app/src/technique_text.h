// SPDX-License-Identifier: Apache-2.0
// A technique in one word, "hard+map-size=1024", by its parts.
#pragma once

#include "app/settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// A setting of a technique and its value. Both live as long as the text and the program.
struct TechniquePart {
    std::string_view key;
    std::string_view value;
};
/// The parts in the order of the text. Throws UsageError for a piece that is no part of a technique, and for a repeated
/// one.
[[nodiscard]] std::vector<TechniquePart> techniqueParts(std::string_view text);

/// Applies the parts and nothing else. Throws UsageError.
void applyTechnique(Settings& settings, std::string_view text);

/// Throws UsageError when a part no longer holds: another option said otherwise.
void requireTechnique(const Settings& settings, std::string_view text);

/// The parts that change nothing in `technique`, which has them and the rest: a sentence each.
[[nodiscard]] std::vector<std::string> partsWithoutEffect(const Settings& technique, std::string_view text);

/// --techniques @FILE: adds the file's techniques to those of the settings, and notes the line of each. Blanks around a
/// technique, empty lines and text after a # are ignored. A plain file of at most 256 KiB with at most 1000 techniques.
/// Throws UsageError that names file and line; Error when the file cannot be read.
void applyTechniqueFile(Settings& settings, std::string_view file);

} // namespace gnomon::app
