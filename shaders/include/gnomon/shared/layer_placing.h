// SPDX-License-Identifier: Apache-2.0
// Push constants of the passes that place layers of depth. 16-byte members, as in gpu_structs.h.
#ifndef GNOMON_LAYER_PLACING_H
#define GNOMON_LAYER_PLACING_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
#define GN_VEC4 glm::vec4
#define GN_IVEC4 glm::ivec4
namespace gnomon::shared {
inline constexpr int kDepthBins = 1024;
inline constexpr int kMostSamplesAlong = 512;
inline constexpr int kMostPairsAlong = 256;
#else
#define GN_VEC4 vec4
#define GN_IVEC4 ivec4
const int kDepthBins = 1024;       // bins of a view's histogram: at 300 m of depth, 0.3 m each
const int kMostSamplesAlong = 512; // texels that are looked at along a tile's side: every fourth one of 2048
const int kMostPairsAlong = 256;   // the same where layers are placed by gaps: each with two others beside it
#endif

struct GpuHistogramPush {
    GN_IVEC4 tile; // x, y, width, height: where the view's depths lie
    // x: step from one texel that is looked at to the next, y: MomentRule::flags, z: texels from one of a pair to the
    // other
    GN_IVEC4 more;
    GN_VEC4 metric; // x: near / far of the view's depth metric
};

struct GpuPlacePush {
    GN_IVEC4 slot; // x: of the layers, y: how many layers, z: most steps, w: MomentRule::flags
    // x: overlap, y: share of the way to the new means that a step goes, z: 1 to begin anew; w: 1 to hold them
    // where they are until a split is off
    GN_VEC4 how;
    // Last frame's depths to this one's metric: x times the linear depth plus y; near / far: z then, w now.
    GN_VEC4 carry;
};

#ifdef __cplusplus
} // namespace gnomon::shared
#endif
#endif
