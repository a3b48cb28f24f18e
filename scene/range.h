// SPDX-License-Identifier: Apache-2.0
// Checks that a scene's size and place allow shadows to be computed.
#pragma once

#include "scene/state.h"

#include <string>

namespace gnomon::scene {

/// Throws Error (gnomon/error.h) when an object's place is not finite, and when the scene's size or its distance from
/// the origin is beyond the limits of gnomon/world_range.h. `tried` begins its sentence.
void requireInRange(const State& state, const std::string& tried);

} // namespace gnomon::scene
