// SPDX-License-Identifier: Apache-2.0
// What `list` knows by name.
#pragma once

#include <string_view>
#include <vector>

namespace gnomon::app {

/// A name that `list` takes, and a line about it.
struct ListedName {
    std::string_view name;
    std::string_view summary;
};
/// Sections, choices and their values, settings, presets and worlds. What several have in common is there once.
[[nodiscard]] std::vector<ListedName> listedNames();
[[nodiscard]] bool isListed(std::string_view name);

} // namespace gnomon::app
