// SPDX-License-Identifier: Apache-2.0
// What the hour does to the light and the sky of the world `sundial`.
#pragma once

#include "../scene_names.h"

#include <glm/vec3.hpp>

namespace gnomon::worlds {

[[nodiscard]] Environment skyAt(double time_s);
/// What the sun gives, as a share of its colour: SundialWorld::sunStrength, and redder the lower it stands.
[[nodiscard]] glm::vec3 sunlightAt(double time_s);

} // namespace gnomon::worlds
