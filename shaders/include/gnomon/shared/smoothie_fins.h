// SPDX-License-Identifier: Apache-2.0
// Fins: smoothies (smoothies.h) of geometry. Along each silhouette edge of a caster, as the light sees it, lies a fin
// on the map, as far as smoothies reach, and says of each texel outside of the caster how far the edge is, and how
// deep. Based on: E. Chan, F. Durand, "Rendering Fake Soft Shadows with Smoothies", EGSR 2003. Departures: their fins
// are quadrangles at edges and corners at vertices, with alpha interpolated over them, and the nearest to the light
// counts. Here a fin is all texels nearer to the edge than the reach, so it is round at its ends and joins its
// neighbours; and where several lie over a texel, that counts which takes most light from the surface there.
#ifndef GNOMON_SMOOTHIE_FINS_H
#define GNOMON_SMOOTHIE_FINS_H
#include "smoothies.h"
GN_BEGIN

// A silhouette edge on the map, or the part of it that the map can show (finCut(), finBeforeNear()).
struct Fin {
    real2 from; // texels
    real2 to;
    real2 outward;   // unit: away from the caster
    real depth_from; // in the map's metric, affine in space
    real depth_to;
    real w_from; // clip space's w, above 0
    real w_to;
};

// Twice the area that the triangle of an edge (from a to b) and the third corner c has on the map, times their w: its
// sign says on which side of the edge c lies, seen from the light, behind which ends may lie. Points are (x, y, w) of
// clip space; those of b and c relative to a are handed in, for their own digits.
GN_FN real finSide(real3 a, real3 b_from_a, real3 c_from_a)
{
    return dot(a, cross(b_from_a, c_from_a));
}

// Is an edge a silhouette, by the sides on which the third corners of its triangles lie? If both lie on one side, one
// triangle faces the light and the other one does not. A triangle that the light grazes (0) may face either way, so the
// edge is one. An edge with a single triangle passes its side twice.
GN_FN bool isSilhouette(real left, real right)
{
    return left * right >= real(0.0) && left + right != real(0.0);
}

// How much of an edge from w_a to w_b is to be cut off at a, as a share of it: the part behind the light, or so near
// before it that a map cannot show where.
GN_FN real finCut(real w_a, real w_b)
{
    real least = real(0.01) * max(w_a, w_b);
    return w_a >= least ? real(0.0) : min((least - w_a) / (w_b - w_a), real(1.0));
}

// How much is to be cut off at a because it lies before the map's near plane, where depth is below 0: what is there
// throws no shadow. Where the map clamps it instead, depths are handed in as 0.
GN_FN real finBeforeNear(real depth_a, real depth_b)
{
    return depth_a >= real(0.0) ? real(0.0) : (depth_b <= real(0.0) ? real(1.0) : depth_a / (depth_a - depth_b));
}

// Unit normal of the edge on the side away from the caster; `side` as finSide() has it, of the caster's triangles.
GN_FN real2 finOutward(real2 from, real2 to, real side)
{
    real2 along = to - from;
    real far = length(along);
    real2 left = far > real(0.0) ? real2(-along.y, along.x) / far : real2(real(0.0), real(1.0));
    return side > real(0.0) ? -left : left;
}

// Corner 0 to 5 of the two triangles that cover all texels of the fin.
GN_FN real2 finCorner(int corner, real2 from, real2 to, real2 outward, real reach)
{
    real margin = reach + real(1.0);
    real2 along = real2(outward.y, -outward.x);
    along = dot(along, to - from) < real(0.0) ? -along : along;
    int k = corner < 3 ? corner : (corner == 3 ? 2 : (corner == 4 ? 1 : 3)); // 0 1 2, 2 1 3
    real2 end = (k & 1) == 0 ? from - along * margin : to + along * margin;
    return end + outward * (k < 2 ? -real(1.0) : margin);
}

// Where on the edge the point nearest to a texel is: 0 at its beginning, 1 at its end, on the map.
GN_FN real finNearest(Fin fin, real2 texel)
{
    real2 along = fin.to - fin.from;
    real square = dot(along, along);
    return square > real(0.0) ? clamp(dot(texel - fin.from, along) / square, real(0.0), real(1.0)) : real(0.0);
}

GN_FN real finDistance(Fin fin, real2 texel, real nearest)
{
    return length(texel - mix(fin.from, fin.to, nearest));
}

// The edge's depth there: depths are affine in space, where what is nearer to the light takes more room on the map.
GN_FN real finDepth(Fin fin, real nearest)
{
    real t = nearest * fin.w_from / mix(fin.w_to, fin.w_from, nearest);
    return mix(fin.depth_from, fin.depth_to, t);
}

// Is a texel on the caster's own side of the edge?
GN_FN bool isBehindFin(Fin fin, real2 texel)
{
    return dot(texel - fin.from, fin.outward) < real(0.0);
}

// How steep the surface is that a map shows, along one axis, in depths a texel: of the ways to both neighbours the
// flatter one, for the other may lead over an edge.
GN_FN real flatterLean(real before, real here, real next)
{
    real back = abs(here - before);
    real on = abs(next - here);
    return min(back, on);
}

// Does an edge lie over the surface that a texel shows, `fall` deeper than the edge? What no further deep than the
// surface itself leans on the way is of that surface, or touches it. `quantum`: what stored depths may be off by.
GN_FN bool isOverSurface(real fall, real lean, real distance, real quantum)
{
    return fall > lean * distance + real(2.0) * quantum;
}

// 0 to 1, the less, the more light a fin takes from a surface: the order of distance / fall, and so of alpha', whatever
// the light's size. Depth tests keep the least.
GN_FN real finOrder(real distance, real fall)
{
    return distance / (distance + real(1024.0) * fall);
}

GN_END
#endif
