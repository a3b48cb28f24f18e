// SPDX-License-Identifier: Apache-2.0
// The inputs of every filter. A filter is a function `real name(MapPoint point, FilterInput f)` in a file of its own.
//
// The includer gives access to the map's texels beforehand, because GLSL and a test on the CPU have them in different
// places. Texel (i, j) is centred on (i + 0.5, j + 0.5); a gather has the four texels that meet at a corner with integer
// coordinates, in the order of textureGather: x: left low, y: right low, z: right high, w: left high, where "low" is the larger y.
//   real mapTexel(real2 texel, real layer, real part);    // texel: integer coordinates
//   real4 mapGather(real2 corner, real layer, real part); // corner: integer coordinates
// `part`: which of the two maps that a texel may hold (gnomon/shared/paired_depth.h).
// Access to blocks (gnomon/shared/map_blocks.h): block (i, j) of a level >= 1 has the texels from (i, j) times 2^level
// on; gives their nearest and farthest depth.
//   real2 mapBlock(real2 block, int level, real layer);
// Access to the smoothie beside a texel (gnomon/shared/smoothies.h), packed:
//   int mapSmoothie(real2 texel, real layer);
// Access to the points of a disc filter's pattern, which are a table on the GPU (gnomon/shared/discs.h):
//   real2 discPoint(int i); // in the unit disc
// Access to filterable maps: an average of texels of one mip level or two, with texel coordinates of the finest level,
// and the layers of depth of a view (GpuDepthLayers::layer):
//   real4 mapMoments(real2 texel, real level, real layer); // bilinear, between levels too
//   real4 mapDepthLayer(int slot, int i);
#ifndef GNOMON_FILTER_TYPES_GLSL
#define GNOMON_FILTER_TYPES_GLSL
#include "../shared/bias.h"
#include "../shared/moment_rule.h"
// A constant: whether cheap values are computed anew in each turn of a loop, and not kept over it. Kept registers limit
// how many pixels a GPU has in flight. A software rasteriser gains nothing and would only do the work.
#ifndef GNOMON_RECOMPUTES
#define GNOMON_RECOMPUTES false
#endif
// A constant: whether a filter that has blocks says what they settle, and of other receivers anything below 0.
#ifndef GNOMON_SETTLES
#define GNOMON_SETTLES false
#endif
GN_BEGIN

struct FilterInput {
    real layer;
    real part;          // in a texel with two maps: 0: the first, 1: the second
    int kernel_width;   // 1, 3, 5, 7: separable; 0: disc; below 0: nine points (pcf_weights.h)
    int disc_taps;      // points of the disc
    real disc_radius;   // texels
    real smoothies;     // texels that those beside the map reach (gnomon/shared/smoothies.h); 0: there are none
    real4 kernel;       // gaussianWeights(kernel_width, sigma); for id and depth-id IdRule
    real2 pixel;        // on the screen, for noise
    real shift;         // shift of that noise from frame to frame, pixels along x and y
    real4 tile;         // the view's whole tile: x0, y0, x1, y1
    // For filters that know how large the light is:
    MapRows rows;
    real3 n;            // the receiver's unit geometric normal
    real3 toward;       // from the receiver to the light's centre; of unit length for a parallel light
    real spread;        // radius, at the end of `toward`, of the disc that the light is seen as
    int stood;          // how many earlier frames that are averaged with this one saw the same; 0: none
    // For id and depth-id:
    real id;            // id of the receiver's object
    real lifted;        // 1: the receiver is on a smooth surface, beside the triangles that the map was drawn from
    real3 place;        // the receiver, in the space of the rows
    real3 object_centre; // centre of its object's box in that space, and half the box's size
    real3 object_half;
    // For filterable maps; for hard and pcf the metric's flag:
    MomentRule moments;
    int slot;           // lvsm: slot of the view's depth layers
    real coarsest;      // last mip level, or level of blocks, that it may read
    real near_over_far; // near / far of the view's depth metric
    real2 footprint_x;  // texels that the receiver's surface moves on the map to the next pixel on the right
    real2 footprint_y;  // and below
};

// Noise is worked out from this place.
GN_FN real2 noisePlace(FilterInput f)
{
    return f.pixel + real2(f.shift);
}

// 1, which no compiler knows. Numbers that depend on a product with it are worked out anew (GNOMON_RECOMPUTES): else a
// compiler finds them equal to those of before, and keeps those.
GN_FN real unknownOne(FilterInput f)
{
    return f.stood < 0 ? real(2.0) : real(1.0);
}

// The linear metric of what a map holds: of one that holds what a lamp's perspective makes of depth, zOverW() backwards.
GN_FN real4 storedMetric(FilterInput f, real4 stored)
{
    real4 metric = stored;
    if (hasFlag(f.moments.flags, kMomentZOverW)) {
        real4 below = max(real4(real(1.0)) - stored * (real(1.0) - f.near_over_far), real4(f.near_over_far));
        // Where nothing was drawn it is 1, without rounding.
        metric = max(stored * f.near_over_far / below, step(real4(real(1.0)), stored));
    }
    return metric;
}

// 1 where the receiver is lit by what one texel holds, else 0. `centre`: of the texel, relative to the receiver.
GN_FN real compareTexel(MapPoint point, real2 centre, real stored)
{
    real2 reference = referenceAt(point, centre);
    return step(reference.x, stored * reference.y);
}

// The same for the four texels of a gather. `centre`: of the top left one (component w), relative to the receiver.
GN_FN real4 compareGather(MapPoint point, real2 centre, real4 stored)
{
    real2 d = point.depth_slope;
    real4 depth = real4(point.depth + dot(d, centre)) + real4(d.y, d.x + d.y, d.x, real(0.0));
    real2 s = point.w_slope * mix(real(1.0), real(0.0), GNOMON_ORTHOGRAPHIC_ONLY);
    real4 w = real4(real(1.0) + dot(s, centre)) + real4(s.y, s.x + s.y, s.x, real(0.0));
    w = max(w, real4(real(0.05)));
    return step(min(depth, w * point.cap), stored * w);
}

GN_END
#endif
