// SPDX-License-Identifier: Apache-2.0
// What the mask pass reads from its uniform buffer, declared once for both sides. Everything is made of 16-byte
// members, so that std140, std430 and C++ agree. "Eye-relative" is world space with the camera's eye as origin, which
// keeps single precision exact near the camera wherever in the world it is.
#ifndef GNOMON_GPU_STRUCTS_H
#define GNOMON_GPU_STRUCTS_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
#define GN_VEC4 glm::vec4
#define GN_UVEC4 glm::uvec4
namespace gnomon::shared {
inline constexpr int kLightsPerLayer = 4;
inline constexpr int kViewsPerLayer = 64;
inline constexpr int kDiscPoints = 64;
inline constexpr int kDepthLayers = 8;
#else
#define GN_VEC4 vec4
#define GN_UVEC4 uvec4
const int kLightsPerLayer = 4;
const int kViewsPerLayer = 64;
const int kDiscPoints = 64;
const int kDepthLayers = 8;
#endif

struct GpuView {
    GN_VEC4 x; // rows that take an eye-relative point to the atlas, see MapRows
    GN_VEC4 y;
    GN_VEC4 w;
    GN_VEC4 metric;
    GN_VEC4 tile; // first and one-past-last texel a receiver may be at: x0, y0, x1, y1; the kernel's reach is taken off
    GN_VEC4 scale;   // x: texel_m, y: range_m, z: layer, w: part of a texel with two maps (paired_depth.h): 0 or 1
    GN_VEC4 plane_x; // of an orthographic view, see MapRows
    GN_VEC4 plane_y;
    GN_VEC4 plane_w;
    GN_VEC4 whole; // all of its tile, as `tile`
    GN_VEC4 more;  // x: slot of its depth layers (lvsm), y: coarsest mip level that it may read, z: near / far
    GN_VEC4 slice; // depths of the camera that it serves: x: begin, y: end, z: one over the width of the blend
};

// The layers of depth of one view's lvsm map, ascending; beyond the last, begins is 2. In the view's depth metric.
struct GpuDepthLayers {
    GN_VEC4 layer[kDepthLayers]; // x: near and y: far that it spans, z: where its receivers begin, w: Lloyd's mean
};

struct GpuLight {
    GN_VEC4 place; // w = 0: xyz is the unit direction to the light; w = 1: its eye-relative position
    // x: first and y: count of its further views; z: 0 when it has no map (then visibility is 1); w: where it is seen
    // from two positions, the count of further views of the later one, which follow those of the earlier one
    GN_UVEC4 views;
};

struct GpuMaskLayer {
    GN_VEC4 eye_x; // rows of eye_from_ndc: (x, y, depth, 1) to eye-relative homogeneous
    GN_VEC4 eye_y;
    GN_VEC4 eye_z;
    GN_VEC4 eye_w;
    GN_VEC4 view_axis;                    // xyz: unit, along the camera's view: depth is the dot product with it
    GN_VEC4 fade;                         // distance from the eye: x: where shadows begin to fade, y: one over the way
    GN_VEC4 screen;                       // xy: size in pixels, zw: one over it
    GN_VEC4 atlas;                        // xy: one over its size in texels; z: the depth of the background (0 or 1)
    GN_VEC4 bias;                         // automatic, constant_m, slope, normal_texels
    GN_VEC4 bias_more;                    // receiver_plane, reach_texels, quantum
    GN_VEC4 kernel;                       // gaussianWeights
    GN_VEC4 disc;                         // x: radius, texels
    GN_VEC4 moment_warp;                  // exponent, negative exponent, moment bias, anisotropy
    GN_VEC4 moment_variance;              // least: absolute, in texel depths; share lost to rounding, c+, c-
    GN_VEC4 moment_shape;                 // linstep, power, lighten
    GN_VEC4 disc_points[kDiscPoints / 2]; // two points of the unit disc each
    GpuLight lights[kLightsPerLayer];
    GN_VEC4 steps[kLightsPerLayer]; // of lights that are seen from two positions: sun_steps.h
    // Light i's first view is views[i], and where a light of the layer is seen from two positions the first view of the
    // later one is views[kLightsPerLayer + i]. Further ones follow from there on.
    GpuView views[kViewsPerLayer];
};

#ifdef __cplusplus
static_assert(sizeof(GpuView) == 192 && sizeof(GpuLight) == 32 && sizeof(GpuDepthLayers) == 128 &&
              sizeof(GpuMaskLayer) == 240 + 32 * 16 + 4 * 32 + 4 * 16 + 64 * 192);
} // namespace gnomon::shared
#endif
#endif
