// SPDX-License-Identifier: Apache-2.0
// The surroundings of a scene's detail: a wide ground, a sky's dome, a backdrop.
#pragma once

#include "scene/model.h"
#include "scene/state.h"

#include <vector>

namespace gnomon::app {

/// The objects without the largest ones, where all of the others together are small beside each of those, lie amid them
/// and have more triangles. A view of such a whole scene would show only its surroundings. In order of size.
[[nodiscard]] std::vector<const scene::Object*> withoutSurroundings(const scene::Scene& scene,
                                                                    std::vector<const scene::Object*> objects);

} // namespace gnomon::app
