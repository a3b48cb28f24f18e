// SPDX-License-Identifier: Apache-2.0
// From a fit's warp to a map: which rectangle of the warped plane it shows, and the matrix that draws it.
#pragma once

#include "fit/fit.h"

#include <gnomon/plan.h>

namespace gnomon {

/// The border that a map of this size can afford, so that at least half of it is left.
[[nodiscard]] double usableBorder(double border_texels, std::uint32_t map_size);

/// The border's share of what it leaves of a map's side.
[[nodiscard]] double borderShare(double border_texels, std::uint32_t map_size);

/// The strongest warp that such a map can bear, > 1 and at most 1000. On the far side the border goes on toward the
/// vanishing line; a texel at its end shall be no more than twice as wide as the widest inside.
[[nodiscard]] double strongestWarp(double border_texels, std::uint32_t map_size);

/// The rectangle that a map shows, as points (x, y) of its warp, and its texels.
struct MapFrame {
    glm::dvec2 centre{0.0};
    glm::dvec2 half{1.0};  // from the centre to the edges, border included
    glm::dvec2 texel{1.0}; // sides of a texel at w = 1, as in LightRect
};

/// The rectangle that the outline takes after the warp.
[[nodiscard]] LightRect rectOf(const Warp& warp, std::span<const glm::dvec2> outline);

/// A map of map_size texels on a side around `rect`, with room for the border. No side is shorter than `least_size`.
/// Departure from Marinescu 2011: the two axes are fitted apart, so a texel may be longer than wide. A map of n x n
/// texels then has the most texels per metre on both axes; square texels would waste the part of the map that a long
/// rectangle leaves over.
[[nodiscard]] MapFrame frameOf(const LightRect& rect, double least_size, std::uint32_t map_size, double border_texels);

/// Longest side of any texel in the outline, as LightRect has it: what its corner at the greatest w has, shear
/// included.
[[nodiscard]] FitReport reportOf(const Warp& warp, const MapFrame& frame, std::span<const glm::dvec2> outline);

/// How far from a point of the outline a filter's reads may be, as LightRect has it, if they stay within the border,
/// and one texel for what is drawn across it.
[[nodiscard]] double borderReach(const Warp& warp, const FitReport& report, double border_texels,
                                 std::uint32_t map_size);

/// z in [0, w] where depth, by space.depth_ws from space.origin_ws, is from near to far and w is at least 1.
[[nodiscard]] glm::dmat4 clipFromWorld(const LightSpace& space, const Warp& warp, const MapFrame& frame, double near_m,
                                       double far_m);

} // namespace gnomon
