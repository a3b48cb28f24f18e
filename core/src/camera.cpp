// SPDX-License-Identifier: Apache-2.0
#include <gnomon/frame.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace gnomon {

bool isOrthographic(const Camera& camera)
{
    const glm::dmat4& m = camera.clip_from_world;
    return !(glm::length(glm::dvec3(m[0].w, m[1].w, m[2].w)) > 0.0);
}

glm::dmat4 clipFromWorld(const Camera& camera)
{
    glm::dmat4 clip = camera.clip_from_world;
    if (camera.clip_depth == ClipDepth::minus_one_to_one) {
        clip = glm::row(clip, 2, (glm::row(clip, 2) + glm::row(clip, 3)) * 0.5);
    }
    return clip;
}

bool sameSight(const Camera& before, const Camera& now, const glm::uvec2& size_px)
{
    constexpr double kRounding = 1e-9; // share of a row's length
    const glm::dvec2 shift = (now.jitter_px - before.jitter_px) * 2.0 / glm::dvec2(size_px);
    for (int i = 0; i < 4; ++i) {
        const glm::dvec4 row = glm::row(now.clip_from_world, i);
        const glm::dvec4 moved = i < 2 ? row - glm::row(now.clip_from_world, 3) * shift[i] : row;
        if (!(glm::distance(moved, glm::row(before.clip_from_world, i)) <= kRounding * glm::length(row))) {
            return false;
        }
    }
    return now.eye_ws == before.eye_ws && now.reversed_z == before.reversed_z && now.clip_depth == before.clip_depth;
}

} // namespace gnomon
