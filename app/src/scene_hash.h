// SPDX-License-Identifier: Apache-2.0
// Tells scenes apart in result files.
#pragma once

#include "scene/model.h"

#include <string>

namespace gnomon::app {

/// Sixteen hexadecimal digits of all geometry, places, materials' colours, images and lights of a scene.
[[nodiscard]] std::string sceneHash(const scene::Scene& scene);

} // namespace gnomon::app
