// SPDX-License-Identifier: Apache-2.0
// The rows of the one setting table, by subject, each in a file *_settings.cpp. settingTable() joins them in this
// order.
#pragma once

#include "app/settings.h"

#include <gnomon/world_range.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace gnomon::app {

using Names = std::vector<std::string_view>;

/// The names of all that the lists have, in their order.
template <typename... Lists>
std::vector<std::string> namesIn(const Lists&... lists)
{
    std::vector<std::string> names;
    (std::ranges::transform(lists, std::back_inserter(names), [](const auto& one) { return one.name; }), ...);
    return names;
}

inline constexpr double kFarthest = kFarthestPlace_m;

void addSceneRows(std::vector<Setting>& table);     // picture, camera, light
void addTechniqueRows(std::vector<Setting>& table); // the library's options
void addRunRows(std::vector<Setting>& table);       // truth, time, run, result

} // namespace gnomon::app
