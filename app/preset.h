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

/// Applies a built-in preset, or a file when no preset has the name. A file is an object of settings, or a result of
/// compare or bench, whose "settings" are taken to repeat the run. Keys that are no option of the subcommand are
/// ignored, so that one file serves all; unknown keys are refused. Throws UsageError, or Error when a file cannot be
/// read.
void applyPreset(Settings& settings, std::string_view name_or_file, std::uint32_t subcommand);
/// Applies the text of a file. Messages call it `name`.
void applyPresetText(Settings& settings, const std::string& name, std::string_view text, std::uint32_t subcommand);

} // namespace gnomon::app
