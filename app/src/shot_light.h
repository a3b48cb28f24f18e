// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/shot.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// Keeps the lights in sight (host::lightsInSight), where there are more than a frame can have. It comes after camera
/// and lights are placed.
void chooseLights(Shot& shot, const Settings& settings);
/// The notice where Shot::lights_left_out is not 0.
[[nodiscard]] std::string leftOutSentence(const Shot& shot);

/// A light of the shot by its name, or by that of a file's node that holds it. Before chooseLights().
[[nodiscard]] std::optional<std::size_t> lightNamed(const Shot& shot, const Settings& settings, std::string_view name);
[[nodiscard]] std::vector<std::string_view> lightNames(const Shot& shot);

} // namespace gnomon::app
