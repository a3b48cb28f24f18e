// SPDX-License-Identifier: Apache-2.0
// Presets: JSON objects of settings, built in or in files.
#pragma once

#include "app/settings.h"

#include <span>
#include <string>
#include <string_view>

namespace gnomon::app {

struct Preset {
    std::string_view name;
    std::string_view summary; // one line, with the source
    std::string_view json;    // {"key": value, ...}; "scene" is allowed too
};
[[nodiscard]] std::span<const Preset> presets();

/// Applies a built-in preset, or a file when no preset has the name. A file is an object of settings, or a result that
/// compare or bench wrote, of which its "settings" are taken: the run is made again. Keys that are no option of the
/// subcommand are passed over, so that one file serves all; unknown keys are refused. Throws UsageError, or Error when
/// a file cannot be read.
void applyPreset(Settings& settings, std::string_view name_or_file, std::uint32_t subcommand);
/// The same of what is in a file. `name` is what messages call it.
void applyPresetText(Settings& settings, const std::string& name, std::string_view text, std::uint32_t subcommand);

} // namespace gnomon::app
