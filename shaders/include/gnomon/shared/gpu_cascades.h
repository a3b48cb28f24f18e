// SPDX-License-Identifier: Apache-2.0
// The data that passes read and write to fit cascades to the camera's depth buffer, declared once for both sides.
// 16-byte members, as in gpu_structs.h.
#ifndef GNOMON_GPU_CASCADES_H
#define GNOMON_GPU_CASCADES_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
#define GN_VEC4 glm::vec4
#define GN_UVEC4 glm::uvec4
#define GN_CASCADE_CONST inline constexpr
#define GN_CASCADE_UINT unsigned int
namespace gnomon::shared {
#else
#define GN_VEC4 vec4
#define GN_UVEC4 uvec4
#define GN_CASCADE_CONST const
#define GN_CASCADE_UINT uint
#endif

GN_CASCADE_CONST int kMostCascades = 6;
GN_CASCADE_CONST int kBoundsGroup = 16;   // threads of a group along x and y
GN_CASCADE_CONST int kBoundsPixels = 4;   // pixels that a thread looks at along x and y
GN_CASCADE_CONST int kCompleteGroup = 64; // views that one group of cascade_constants.comp completes
GN_CASCADE_CONST int kDepthKeys = 2;      // in GpuCascadeKeys::key: least and greatest depth, then the cascades' bounds
GN_CASCADE_CONST int kBoundKeys = 8;      // for a cascade: x, y low, then high; then both with room on all sides

// One light that is fitted on the GPU.
struct GpuCascadeLight {
    GN_VEC4 eye_x; // as GpuScreen
    GN_VEC4 eye_y;
    GN_VEC4 eye_z;
    GN_VEC4 eye_w;
    GN_VEC4 view_axis;
    GN_VEC4 screen;
    GN_VEC4 base_x; // rows that take an eye-relative point to the base map, x and y in [-w, w]
    GN_VEC4 base_y;
    GN_VEC4 base_w;
    GN_VEC4 reach; // x: depth of the background, y: greatest distance from the eye, m; z, w: of |x| / w, |y| / w
    GN_VEC4 split; // x: lambda, y: blend; z, w: axisPlace's `widen`
    GN_UVEC4
    cascades; // x: how many, y: first view of the plan, z: 1 for ends that are given, w: 1 for a perspective camera
    GN_VEC4 ends[2]; // given: where all cascades but the last end, m
    GN_VEC4 texel; // x, y: ViewProjection::texel_xy_m of the base map, z, w: how far each cascade is moved, of its own
                   // [-1, 1]
    GN_VEC4
    room; // x, y: on all sides of a pixel's place, for ViewProjection::light_reach; z: 1: of a place where w is 1
};

// Found so far, as whole numbers that only grow, so that the order in which pixels come does not matter: greatestKey()
// of greatest values and of negated least ones; 0: nothing yet.
struct GpuCascadeKeys {
    GN_CASCADE_UINT key[kBoundKeys * kMostCascades + 4]; // cascade i's from kBoundKeys i + kDepthKeys on
};

// The fit that was found for a view.
struct GpuFittedView {
    GN_VEC4 place; // x, y: scale, z, w: centre; see casterPlaced()
    GN_VEC4 slice; // x: begin, y: end, z: one over the width of the blend (0: none), w: ViewProjection::texel_m
    GN_VEC4 seen;  // rectangle of the base map that the slice's pixels lie in: low x, y, high x, y; low > high: none
};

#ifdef __cplusplus
static_assert(sizeof(GpuCascadeLight) == 16 * 16 && sizeof(GpuCascadeKeys) == 52 * 4 && sizeof(GpuFittedView) == 48);
} // namespace gnomon::shared
#endif
#endif
