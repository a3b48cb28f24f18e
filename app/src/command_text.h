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

/// As a POSIX shell takes it for one word: as it is, or between single quotes.
[[nodiscard]] std::string shellWord(std::string_view text);
/// "gnomon compare rts --size=640x360": the program and words behind its name, each as shellWord() has it.
[[nodiscard]] std::string shellText(std::span<const std::string> words);

/// What stands behind the program's name: one technique of a run of `subcommand` (kRender, kCompare or kBench), with
/// every setting that is not at its default. `technique` is as describeTechnique() gives it, so what of it other
/// settings gave is in it. What says where results go is left out, and so are --sweep, whose point the settings have,
/// and what has no effect on a picture of `render`.
[[nodiscard]] std::vector<std::string> commandWords(const Settings& settings, std::uint32_t subcommand,
                                                    std::string_view technique);
/// The same as shellText() has it.
[[nodiscard]] std::string commandText(const Settings& settings, std::uint32_t subcommand, std::string_view technique);

} // namespace gnomon::app
