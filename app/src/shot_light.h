// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/shot.h"

#include <string>

namespace gnomon::app {

/// Of more lights than a frame can have, keeps those in sight (host::lightsInSight). After camera and lights are
/// placed.
void chooseLights(Shot& shot, const Settings& settings);
/// What to say where Shot::lights_left_out is not 0.
[[nodiscard]] std::string leftOutSentence(const Shot& shot);

} // namespace gnomon::app
