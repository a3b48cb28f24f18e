// SPDX-License-Identifier: Apache-2.0
// The light-space box of what matters: all texels the same size.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 4.
// Departure: the two axes are fitted apart, so a texel may be longer than wide. A map of n x n texels then has the most
// texels per metre on both axes; square texels would waste the part of the map that a long rectangle leaves over.
#include "fit/fit.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace gnomon {

FitResult fitUniform(const FitInput& input)
{
    const LightSpace& space = input.space;
    const double border = usableBorder(input.border_texels, input.map_size);
    const double texels = static_cast<double>(input.map_size);

    // size + 2 * border * texel spread over all texels, with texel = size / (texels - 2 * border).
    const glm::dvec2 size = glm::max(input.rect.high - input.rect.low, glm::dvec2(input.least_size));
    const glm::dvec2 centre = (input.rect.high + input.rect.low) * 0.5;
    FitResult result;
    result.texel_xy = size / (texels - 2.0 * border);
    result.orthographic = !space.perspective;
    const glm::dvec2 half = result.texel_xy * texels * 0.5;

    // Rows of clip_from_world, made of the rows that measure x, y and depth. y is down in a Vulkan framebuffer.
    const auto row = [&](const glm::dvec3& axis) {
        return glm::dvec4(axis, -glm::dot(axis, space.origin_ws));
    };
    const glm::dvec4 one(0.0, 0.0, 0.0, 1.0);
    const glm::dvec4 depth = row(space.depth_ws);
    const glm::dvec4 w = space.perspective ? depth : one;
    const double length = input.far_m - input.near_m;
    const glm::dvec4 z = space.perspective ? (depth - one * input.near_m) * (input.far_m / length)
                                           : (depth - one * input.near_m) / length;
    const glm::dmat4 rows((row(space.right_ws) - w * centre.x) / half.x, -(row(space.up_ws) - w * centre.y) / half.y, z,
                          w);
    result.clip_from_world = glm::transpose(rows);
    return result;
}

} // namespace gnomon
