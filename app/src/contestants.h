// SPDX-License-Identifier: Apache-2.0
// The techniques of `bench` and `compare`.
#pragma once

#include "app/settings.h"

#include <string>
#include <vector>

namespace gnomon::app {

/// Whether options or presets name one technique, by a setting that the default list would override.
[[nodiscard]] bool namesOneTechnique(const Settings& settings);

/// Whether a list makes the techniques. The options are then common to all of them, and are no technique by themselves.
[[nodiscard]] bool hasManyTechniques(const Settings& settings);

/// The techniques asked for, each as one may write it in a list of --techniques beside the same options.
[[nodiscard]] std::vector<std::string> techniqueList(const Settings& settings);

/// The settings of every technique asked for: those of --techniques; without it the one that the options name, else
/// hard, every kernel of pcf and every filterable map, less those that cannot have a map format that was given. Throws
/// UsageError when two of them are the same.
[[nodiscard]] std::vector<Settings> contestants(const Settings& settings);

} // namespace gnomon::app
