// SPDX-License-Identifier: Apache-2.0
// Small scenes of boxes and sheets, for tests of masks beside the truth.
#pragma once

#include "scene/model.h"

#include <glm/vec3.hpp>

namespace gnomon::lab::test {

/// A node with a mesh of six faces of its own vertices. A side of no length leaves the box's two large faces.
void addBox(scene::Scene& scene, const glm::vec3& low, const glm::vec3& high);
/// A node with a sun. `direction`: the way light travels, any length.
void addSun(scene::Scene& scene, const glm::vec3& direction, float angular_diameter_rad = 0.0F);
/// A node with a point light, or a spot light straight down of that cone, degrees across.
void addLamp(scene::Scene& scene, const glm::vec3& place, float cone_deg = 0.0F);
/// Adds a view named "view".
void addView(scene::Scene& scene, const glm::vec3& eye, const glm::vec3& target, float fov_y_rad = 0.8F);

} // namespace gnomon::lab::test
