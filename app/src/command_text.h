// SPDX-License-Identifier: Apache-2.0
// The command line that does a run again, for people to copy.
#pragma once

#include "app/settings.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// The text as one word of a POSIX shell: unchanged, or between single quotes.
[[nodiscard]] std::string shellWord(std::string_view text);
/// "gnomon compare rts --size=640x360": the program and words behind its name, each as shellWord() has it.
[[nodiscard]] std::string shellText(std::span<const std::string> words);

/// The words after the program's name that run one technique of `subcommand` (kRender, kCompare or kBench), with every
/// setting that is not at its default. `technique` is as describeTechnique() gives it, so it includes parts that other
/// settings gave. Left out are the places of results, --sweep, whose point the settings have, and settings that have no
/// effect on a picture of `render`.
[[nodiscard]] std::vector<std::string> commandWords(const Settings& settings, std::uint32_t subcommand,
                                                    std::string_view technique);
/// The program and those words, as shellText() writes them.
[[nodiscard]] std::string commandText(const Settings& settings, std::uint32_t subcommand, std::string_view technique);

} // namespace gnomon::app
