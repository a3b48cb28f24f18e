// SPDX-License-Identifier: Apache-2.0
// What soften=converge moves from frame to frame.
#pragma once

#include <gnomon/export.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon {

/// Along each axis of a map.
inline constexpr double kMostGridMove_texels = 0.5;

/// One frame's share of the mean over texels, light and pixel. Any run of frames covers each of the three evenly.
struct ConvergeSample {
    glm::dvec2 grid_texels{0.0}; // how far a map's grid is moved; each within kMostGridMove_texels
    /// A point of the unit ball, seen from any side evenly distributed over the unit disc; x and y alone as well.
    glm::dvec3 light{0.0};
    /// Where in its pixel a frame looks, from the pixel's centre; each within 0.5. For hosts that average pixels: move
    /// the projection by it, and say so in Camera::jitter_px.
    glm::dvec2 pixel_px{0.0};
};
/// Of frame 0 all is 0: that frame is what it would be without `converge`. A planner counts its frames from the last
/// cut on.
[[nodiscard]] GNOMON_API ConvergeSample convergeSample(std::uint64_t frame);

} // namespace gnomon
