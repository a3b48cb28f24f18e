// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/shot.h"

#include <string>

namespace gnomon::app {

/// Keeps the lights in sight (host::lightsInSight), where there are more than a frame can have. It comes after camera
/// and lights are placed.
void chooseLights(Shot& shot, const Settings& settings);
/// The notice where Shot::lights_left_out is not 0.
[[nodiscard]] std::string leftOutSentence(const Shot& shot);

} // namespace gnomon::app
