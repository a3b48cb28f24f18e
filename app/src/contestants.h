// SPDX-License-Identifier: Apache-2.0
// Which techniques `bench` and `compare` are about.
#pragma once

#include "app/settings.h"

#include <string>
#include <vector>

namespace gnomon::app {

/// Whether the options and presets say themselves which technique it is: by what the default list would override.
[[nodiscard]] bool namesOneTechnique(const Settings& settings);

/// Whether a list makes the techniques; then the options are what they have in common, and no technique by themselves.
[[nodiscard]] bool hasManyTechniques(const Settings& settings);

/// The techniques asked for, each as one may write it in a list of --techniques beside the same options.
[[nodiscard]] std::vector<std::string> techniqueList(const Settings& settings);

/// The settings of every technique asked for: those of --techniques; without it the one that the options name, else
/// hard, every kernel of pcf and every filterable map, less those that cannot have a map format that was given. Throws
/// UsageError when two of them are the same.
[[nodiscard]] std::vector<Settings> contestants(const Settings& settings);

} // namespace gnomon::app
