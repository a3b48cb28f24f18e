// SPDX-License-Identifier: Apache-2.0
// The inputs of the passes that make a map filterable, declared once for both sides.
#ifndef GNOMON_FILTER_PASS_H
#define GNOMON_FILTER_PASS_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
#define GN_IVEC4 glm::ivec4
#define GN_PLACE_VEC4 glm::vec4
namespace gnomon::shared {
#define GN_FILTER_CONST inline constexpr
#define GN_UINT unsigned int
#else
#define GN_IVEC4 ivec4
#define GN_PLACE_VEC4 vec4
#define GN_FILTER_CONST const
#define GN_UINT uint
#endif

GN_FILTER_CONST int kBlockTexels = 32;     // side of the squares that are blurred or left out as one
GN_FILTER_CONST int kMostImageLayers = 4;  // image layers of one map: lvsm with eight layers
GN_FILTER_CONST int kMostBlurRadius = 31;  // less than a block, so that only neighbours of a block reach into it
GN_FILTER_CONST int kWalkTexels = 8;       // that a thread makes where nothing is blurred
GN_FILTER_CONST int kBlurTableLength = 48; // weights by distance; zeros from the radius on, as far as shaders look

// Push constants of every pass.
struct FilterPassPlace {
    GN_IVEC4 source;      // x, y: the tile's first texel; z: its first image layer; w: slot of its depth layers (lvsm)
    GN_IVEC4 target;      // x, y: the first texel that is written; z: its first image layer; w: image layers of the map
    GN_IVEC4 size;        // x, y: the tile in texels, at the level that is written; z, w: in blocks
    GN_IVEC4 strips;      // the scratch image's, x: width in texels; y: how many for an image layer of the map
    GN_PLACE_VEC4 metric; // x: near / far of the view, 1 under a parallel light
};

// The blur's weights. weight[d].x is the weight of the texel at distance d. y and z are for reading two texels at once
// with a linear filter: weight[0] is the middle alone, weight[i] the texels 2 i - 1 and 2 i together; y: distance, z:
// weight.
struct BlurKernel {
    GN_PLACE_VEC4 weight[kBlurTableLength];
};

// Written by the GPU: texels of all image layers.
struct BlurCounts {
    GN_UINT blurred; // in both directions
    GN_UINT filled;  // with what is lit, instead of the second
    GN_UINT unused[2];
};

#ifdef __cplusplus
static_assert(sizeof(FilterPassPlace) == 80 && sizeof(BlurKernel) == 16 * kBlurTableLength && sizeof(BlurCounts) == 16);
} // namespace gnomon::shared
#endif
#endif
