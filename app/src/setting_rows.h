// SPDX-License-Identifier: Apache-2.0
// The rows of the one setting table, by subject, each in a file *_settings.cpp. settingTable() joins them in this
// order.
#pragma once

#include "app/settings.h"

#include <gnomon/world_range.h>

#include <vector>

namespace gnomon::app {

/// The names of an enum's first `count` values, in their order.
template <typename Enum>
std::vector<std::string_view> enumNames(std::uint8_t count)
{
    std::vector<std::string_view> names;
    for (std::uint8_t i = 0; i < count; ++i) {
        names.push_back(nameOf(static_cast<Enum>(i)));
    }
    return names;
}

inline constexpr double kFarthest = kFarthestPlace_m;

void addSceneRows(std::vector<Setting>& table);     // picture, camera, light
void addTechniqueRows(std::vector<Setting>& table); // the library's options
void addRunRows(std::vector<Setting>& table);       // truth, time, run, result

} // namespace gnomon::app
