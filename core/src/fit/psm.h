// SPDX-License-Identifier: Apache-2.0
// The image of a light in the camera's post-perspective space.
#pragma once

#include "fit/fit.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

/// Stamminger and Drettakis' cases. A light in front of the camera's plane is a point light in post-perspective space,
/// one behind it an inverse one, whose rays run toward it; one in that plane is parallel. For the sun that is where it
/// shines from.
enum class PsmLight : std::uint8_t { point, inverse, parallel };

struct PsmImage {
    /// Rows of the camera's matrix, its depth range that of what is seen: from -1 to 1, as x and y.
    glm::dmat4 clip_rows{0.0};
    glm::dvec4 light{0.0}; // image of the light, homogeneous
    PsmLight kind = PsmLight::point;
    bool inside = false; // the image is in the cube of what is seen
};
/// Precondition: the camera is perspective.
[[nodiscard]] PsmImage psmImageOf(const FitInput& input);

} // namespace gnomon
