// SPDX-License-Identifier: Apache-2.0
// The names that `list` knows.
#pragma once

#include <string_view>
#include <vector>

namespace gnomon::app {

/// A name that `list` takes, and a line about it.
struct ListedName {
    std::string_view name;
    std::string_view summary;
};
/// Sections, choices and their values, settings, presets and worlds. A name that several of them have is there once.
[[nodiscard]] std::vector<ListedName> listedNames();
[[nodiscard]] bool isListed(std::string_view name);

} // namespace gnomon::app
