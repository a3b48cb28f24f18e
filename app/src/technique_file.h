// SPDX-License-Identifier: Apache-2.0
// A file of techniques for --techniques @FILE: one a line.
#pragma once

#include "app/settings.h"

#include <string_view>

namespace gnomon::app {

/// Adds the file's techniques to those of the settings, and notes the line of each. Blanks around a technique, empty
/// lines and text after a # are ignored. A plain file of at most 256 KiB with at most 1000 techniques. Throws
/// UsageError that names file and line; Error when the file cannot be read.
void applyTechniqueFile(Settings& settings, std::string_view file);

} // namespace gnomon::app
