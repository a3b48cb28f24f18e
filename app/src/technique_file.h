// SPDX-License-Identifier: Apache-2.0
// A file of techniques, as --techniques @FILE takes it: one a line.
#pragma once

#include "app/settings.h"

#include <string_view>

namespace gnomon::app {

/// Adds the file's techniques to those there are, and notes where each stands. Blanks around a technique, empty lines
/// and what follows a # are passed over. A plain file of at most 256 KiB with at most 1000 techniques. Throws
/// UsageError that names file and line; Error when the file cannot be read.
void applyTechniqueFile(Settings& settings, std::string_view file);

} // namespace gnomon::app
