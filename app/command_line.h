// SPDX-License-Identifier: Apache-2.0
// From argv to a subcommand and its settings, and from the setting table to help.
#pragma once

#include "app/settings.h"

#include <span>
#include <string>

namespace gnomon::app {

/// A subcommand as help and dispatch know it.
struct Subcommand {
    std::string_view name;
    std::uint32_t bit;          // kRender ...
    std::string_view arguments; // "[SCENE]"
    std::string_view summary;   // one line
    int (*run)(const Settings& settings);
};
[[nodiscard]] std::span<const Subcommand> subcommands();

struct Command {
    enum class Kind : std::uint8_t { run, help, version };
    Kind kind = Kind::run;
    const Subcommand* subcommand = nullptr; // null: the program itself
    Settings settings;
    std::vector<std::string> notices; // options that have no effect, a sentence each, for people
};
/// `arguments` without the program's name. Throws UsageError; Error when a preset's file cannot be read.
[[nodiscard]] Command parseCommandLine(std::span<const std::string> arguments);

/// The names of the subcommands that have it.
[[nodiscard]] std::vector<std::string_view> subcommandsOf(const Setting& setting);
/// How help writes the option: "-o, --out FILE".
[[nodiscard]] std::string optionText(const Setting& setting);
/// At most 40 lines of at most 100 columns.
[[nodiscard]] std::string helpText(const Subcommand* subcommand);

/// The whole program but main(): runs and returns the exit status; prints one line on stderr when it fails.
[[nodiscard]] int runProgram(std::span<const std::string> arguments);

} // namespace gnomon::app
