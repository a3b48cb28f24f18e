// SPDX-License-Identifier: Apache-2.0
// Light and sky of the world `sundial` by the hour.
#pragma once

#include "../scene_names.h"

#include <glm/vec3.hpp>

namespace gnomon::worlds {

[[nodiscard]] Environment skyAt(double time_s);
/// The sun's light as a share of its colour: SundialWorld::sunStrength, redder the lower the sun stands.
[[nodiscard]] glm::vec3 sunlightAt(double time_s);

} // namespace gnomon::worlds
