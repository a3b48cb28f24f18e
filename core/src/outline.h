// SPDX-License-Identifier: Apache-2.0
// Convex outlines in the plane across a light.
#pragma once

#include <glm/vec2.hpp>

#include <vector>

namespace gnomon {

/// The convex outline of points, of which there is one at least, counter-clockwise. Sorts the points.
void outlineOf(std::vector<glm::dvec2>& points, std::vector<glm::dvec2>& outline);

/// Makes an outline larger: of each point it holds the square that reaches so far on all sides. Fills `scratch`.
void widenOutline(std::vector<glm::dvec2>& outline, double by, std::vector<glm::dvec2>& scratch);

} // namespace gnomon
