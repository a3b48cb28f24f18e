// SPDX-License-Identifier: Apache-2.0
// The data that shaders read to find a light's visibility, declared once for both sides. Everything is made of 16-byte
// members, so that std140, std430 and C++ agree. "Eye-relative" is world space with the camera's eye as origin, which
// keeps single precision exact near the camera wherever in the world it is.
#ifndef GNOMON_GPU_STRUCTS_H
#define GNOMON_GPU_STRUCTS_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
#define GN_VEC4 glm::vec4
#define GN_IVEC4 glm::ivec4
#define GN_UVEC4 glm::uvec4
namespace gnomon::shared {
inline constexpr int kLightsPerLayer = 4;
inline constexpr int kDiscPoints = 64;
inline constexpr int kDepthLayers = 8;
inline constexpr unsigned kFewViews = 6;
#else
#define GN_VEC4 vec4
#define GN_IVEC4 ivec4
#define GN_UVEC4 uvec4
const int kLightsPerLayer = 4;
const int kDiscPoints = 64;
const int kDepthLayers = 8;
const uint kFewViews = 6;
#endif

// One map of one light: a storage buffer of them, as long as it needs to be, in the plan's order.
struct GpuView {
    GN_VEC4 x; // rows that take an eye-relative point to the atlas, see MapRows
    GN_VEC4 y;
    GN_VEC4 w;
    GN_VEC4 metric;
    GN_VEC4 tile; // first and one-past-last texel a receiver may be at: x0, y0, x1, y1; the kernel's reach is taken off
    GN_VEC4 scale; // x: texel_m, y: range_m, z: layer, w: part of a texel with two maps (paired_depth.h): 0 or 1
    // For an orthographic view, see MapRows. For a paraboloid x, y and w take an eye-relative point to q
    // (paraboloid.h), metric.w is minus near in lengths of far - near, plane_x is `places` of paraboloidRows(), and
    // plane_y.w is 1, else 0. For ViewServes::layered views plane_x.w is one over ViewServes::rim, for others that are
    // no paraboloids 0
    GN_VEC4 plane_x;
    GN_VEC4 plane_y;
    GN_VEC4 plane_w;
    GN_VEC4 whole; // all of its tile, in the form of `tile`
    GN_VEC4 more; // x: slot of its depth layers (lvsm), y: coarsest mip level, or level of blocks, that it may read, z:
                  // near / far, w: one past its layer of the maps of tints; 0: no blended caster is in it
    // Its ViewSlice: x: begin, y: end, z: one over the width of the blend; w: how far it has faded in over views before
    // it; while the GPU has yet to fit it (cascade_constants.comp): minus one past its number in the plan
    GN_VEC4 slice;
    GN_VEC4 slice_axis; // row that takes an eye-relative point to a depth; `slice` is this over sector_w's
    GN_VEC4 sector_x;   // rows that take an eye-relative point to its place among views side by side: ViewSector
    GN_VEC4 sector_y;
    GN_VEC4 sector_w;
};

// The layers of depth of one view's lvsm map, ascending; beyond the last, begins is 2. In the view's depth metric.
struct GpuDepthLayers {
    GN_VEC4 layer[kDepthLayers]; // x: near and y: far that it spans, z: where its receivers begin, w: Lloyd's mean or z
};

// A storage buffer of them: the frame's lights by their index, then what the mask pass alone reads.
struct GpuLight {
    GN_VEC4 place; // w = 0: xyz is the unit direction to the light; w = 1: its eye-relative position
    // x: the light's size: radius in metres, or of a directional light the tangent of half its angular diameter; yzw:
    // the direction in which it shines, unit
    GN_VEC4 size;
    // x: first and y: count of its views; none: it has no map and reaches everything. Where it is seen from two
    // positions these are the earlier one's, z: first and w: count of the later one's, else w is 0
    GN_UVEC4 views;
    GN_VEC4 steps; // where it is seen from two positions: sun_steps.h
    // x: index into Plan::options, whose GpuConstants it uses. For filters id and depth-id y: the first vector of
    // pack::fillObjects() with its ids, z: how many objects there are, w: 1: pieces have ids. With partition virtual y:
    // its first entry in pack::fillPageTable()
    GN_UVEC4 options;
};

// The numbers of a light's options, for the filter that reads its maps.
struct GpuRule {
    // x: 1: automatic; by hand 0, and constant_m, slope, normal_texels (BiasRule). Automatic: y: snap_texels; z: how
    // far along each axis of the picture the point of a receiver may lie, pixels; w: normal_error
    GN_VEC4 bias;
    // x: by hand receiver_plane; automatic: by how much the depth of a receiver may be rounded; yzw: reach_texels,
    // quantum, exact_plane
    GN_VEC4 bias_more;
    GN_VEC4 kernel;      // gaussianWeights; of id and depth-id IdRule (object_ids.h): -ids where they have an order
    GN_VEC4 disc;        // x: radius, texels; y: frame, for noise; zw: one over the size of the maps' image in texels
    GN_VEC4 moment_warp; // exponent, negative exponent, moment bias, anisotropy
    GN_VEC4 moment_variance;              // least: absolute, in texel depths; share lost to rounding, c+, c-; of hard
                                          // and pcf w: texels that smoothies reach, or 0
    GN_VEC4 moment_shape;                 // linstep, power; of every filter lighten and its cut
    GN_IVEC4 reading;                     // gnomon::Filter, kernel width, taps of the disc, holding (paired_depth.h)
    GN_IVEC4 moments;                     // MomentRule's flags, sampling and layers; FilterInput::stood
    GN_VEC4 disc_points[kDiscPoints / 2]; // two points of the unit disc each
};

// The numbers that all of a picture's pixels share.
struct GpuScreen {
    GN_VEC4 eye_x; // rows of eye_from_ndc: (x, y, depth, 1) to eye-relative homogeneous
    GN_VEC4 eye_y;
    GN_VEC4 eye_z;
    GN_VEC4 eye_w;
    GN_VEC4 clip_w; // the row that takes an eye-relative point to clip space's w
    // Distance from the eye: x: where shadows begin to fade, y: one over the way; z: the background's depth
    GN_VEC4 fade;
    GN_VEC4 size; // xy: in pixels, zw: one over it
};

// A uniform block: of the mask pass one for each options index; of a host that shades from the maps itself, one.
struct GpuConstants {
    GpuScreen screen;
    GpuRule rule;
};

#ifdef __cplusplus
static_assert(sizeof(GpuView) == 256 && sizeof(GpuLight) == 80 && sizeof(GpuDepthLayers) == 128 &&
              sizeof(GpuRule) == 144 + 32 * 16 && sizeof(GpuScreen) == 112 && sizeof(GpuConstants) == 768);
} // namespace gnomon::shared
#endif
#endif
