// SPDX-License-Identifier: Apache-2.0
// The three places that soften=converge moves from frame to frame.
#pragma once

#include <gnomon/export.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon {

/// The farthest that a map's grid is moved along each of its axes.
inline constexpr double kMostGridMove_texels = 0.5;

/// One frame's share of the mean over texels, light and pixel. Any run of frames covers each of the three evenly.
struct ConvergeSample {
    glm::dvec2 grid_texels{0.0}; // how far a map's grid is moved; each within kMostGridMove_texels
    /// A point of the unit ball, seen from any side evenly distributed over the unit disc; x and y alone as well.
    glm::dvec3 light{0.0};
    /// Where in its pixel a frame looks, from the pixel's centre; each within 0.5. A host that averages pixels moves
    /// its projection by this and gives it as Camera::jitter_px.
    glm::dvec2 pixel_px{0.0};
};
/// The sample of a frame. In frame 0 all is 0, so that frame is the same as without `converge`. A planner counts its
/// frames from the last cut on.
[[nodiscard]] GNOMON_API ConvergeSample convergeSample(std::uint64_t frame);

} // namespace gnomon
