// SPDX-License-Identifier: Apache-2.0
// What is drawn over the picture to explain it: where the frusta of a light's maps are, and the maps themselves.
#pragma once

#include "view/map_inset.h"
#include "view/pointer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::app::view {

/// Edges of the box that a map's projection shows, as lines in the picture: points in [0, 1] from its top left. What is
/// behind the eye is cut off, and edges through infinity are left out.
[[nodiscard]] std::vector<std::pair<glm::dvec2, glm::dvec2>> edgesInPicture(const glm::dmat4& clip_from_world,
                                                                            const glm::dmat4& map_from_world);

/// The frusta of all maps of the light in question, each in a colour of its own.
void drawFrusta(Viewer& viewer, const PictureArea& area);
/// Outlines and legend of the inset, which lies in the lower right corner of the picture at `at`, `size` large; the
/// desktop's units.
void drawSquares(const MapInset& inset, const glm::dvec2& at, const glm::dvec2& size);

} // namespace gnomon::app::view
