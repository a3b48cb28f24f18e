// SPDX-License-Identifier: Apache-2.0
// The inputs of the pass that joins masks over frames, declared once for both sides. 16-byte members, as in
// gpu_structs.h.
#ifndef GNOMON_GPU_CONVERGE_H
#define GNOMON_GPU_CONVERGE_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
#define GN_VEC4 glm::vec4
#define GN_UVEC4 glm::uvec4
namespace gnomon::shared {
inline constexpr int kMovedBoxes = 16;
#else
#define GN_VEC4 vec4
#define GN_UVEC4 uvec4
const int kMovedBoxes = 16;
#endif

// The inputs for one layer of the mask: four lights.
struct GpuConverge {
    GN_VEC4 before_x; // as Reprojection in lib/reprojection.glsl
    GN_VEC4 before_y;
    GN_VEC4 before_w;
    GN_VEC4 before_eye;
    GN_VEC4 most;     // by light: the frames before count as at most this number; 0: they do not count
    GN_VEC4 size;     // by light: GpuLight::size.x
    GN_VEC4 pad;      // by light: mayShadow()'s, metres
    GN_VEC4 power;    // by light: confidencePower()
    GN_VEC4 least;    // by light: mostInMotion()'s
    GN_VEC4 place[4]; // by light: GpuLight::place, of the light's own middle
    // x: how many boxes; y: 1 where the camera stands as it did; w: 1 where both frames have
    // normals
    GN_UVEC4 state;
    GN_VEC4 box[2 * kMovedBoxes]; // eye-relative: centre, then half its size
};

#ifdef __cplusplus
static_assert(sizeof(GpuConverge) == (4 + 5 + 4 + 1 + 2 * kMovedBoxes) * 16);
} // namespace gnomon::shared
#endif
#endif
