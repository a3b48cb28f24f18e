// SPDX-License-Identifier: Apache-2.0
// Settings as the command line that makes them.
#pragma once

#include "app/settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// What to give to the program, behind its name, so that `subcommand` (kRender ...) does it with these settings; in the
/// order of the table, the technique in one word. What is at its default, has no effect or is of the command line only
/// (--out, --json) is left out.
[[nodiscard]] std::vector<std::string> argumentsOf(const Settings& settings, std::uint32_t subcommand);
/// The words as one types them in a POSIX shell: quoted where a shell would take them apart.
[[nodiscard]] std::string shellText(const std::vector<std::string>& words);

} // namespace gnomon::app
