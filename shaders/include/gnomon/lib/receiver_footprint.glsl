// SPDX-License-Identifier: Apache-2.0
// How far on the map the receiver's surface moves from one pixel of the screen to the next: what a filterable map's mip
// level and its anisotropic reads are chosen by. Not from differences between pixels (dFdx), which at a silhouette
// join two surfaces and know nothing of either, but exactly, from the neighbouring pixel's ray and the receiver's
// plane.
#ifndef GNOMON_RECEIVER_FOOTPRINT_GLSL
#define GNOMON_RECEIVER_FOOTPRINT_GLSL
#include "../shared/bias.h"
#include "../shared/footprint.h"
GN_BEGIN

// How a receiver's homogeneous point (p, 1) changes: to the next pixel on the right and below at the same value of the
// depth buffer, and along the pixel's ray. Any camera has such steps, orthographic and oblique ones too.
struct PixelSteps {
    real4 right;
    real4 below;
    real4 along;
};

// A neighbour's ray may meet the plane far off or not at all. It is then taken where the plane is
// kFarthestNeighbour times as far from the eye, or from a light with a place, as at the receiver.
GN_CONST real kFarthestNeighbour = real(16.0);
// Sine of the angle between ray and plane below which the plane counts as no steeper.
GN_CONST real kEdgeOn = real(0.0001);

// The columns of the matrix that takes (x, y, depth, 1) in normalised device coordinates to homogeneous points, given
// as rows; `w` is that of the receiver's point by this matrix, and `pixel` the size of one in x and y.
GN_FN PixelSteps pixelSteps(real4 row_x, real4 row_y, real4 row_z, real4 row_w, real w, real2 pixel)
{
    PixelSteps s;
    s.right = real4(row_x.x, row_y.x, row_z.x, row_w.x) * (pixel.x / w);
    s.below = real4(row_x.y, row_y.y, row_z.y, row_w.y) * (pixel.y / w);
    s.along = real4(row_x.z, row_y.z, row_z.z, row_w.z) / w;
    return s;
}

// By how much the homogeneous point (p, 1) + d is nearer to the plane through p than p itself, per d.
GN_FN real towardsPlane(real3 n, real3 p, real4 d)
{
    return dot(n, real3(d.x, d.y, d.z) - p * d.w);
}

// How far a receiver that comes from the camera's depth may be off its plane, metres: `snap_px` is how far along each
// axis of the picture the point may lie whose depth the pixel has, `rounding` by how much that depth may be rounded. At
// one depth the neighbouring pixel's point is as far off the plane as it would have been there: towardsPlane() of
// pixelSteps(), whose rows, w and pixel these are, for all three at once.
GN_FN real offPlane(real4 row_x, real4 row_y, real4 row_z, real4 row_w, real w, real2 pixel, real3 p, real3 n,
                    real snap_px, real rounding)
{
    real4 towards = row_x * n.x + row_y * n.y + row_z * n.z - row_w * dot(n, p);
    return (snap_px * (abs(towards.x) * pixel.x + abs(towards.y) * pixel.y) + rounding * abs(towards.z)) / abs(w);
}

// Texels from the receiver's place in the map, `texel`, to where one step takes it. `w` is that of the map at p.
//
// Derivation. With P = (p, 1), step S and ray A the neighbour's ray is P + S + t A. It meets the plane through p, whose
// distance e(.) is linear and zero at P, where e(S) + t e(A) = 0; so at P + D with D = S - A e(S) / e(A). On the map
// that is (X.P + X.D) / (W.P + W.D), and less u = X.P / W.P this is (X.D - u W.D) / (W.P + W.D): no difference of
// large numbers. Along k D, k in [0, 1], points stay on the plane and on the way to the neighbour, so the bounds are
// kept by a smaller k.
GN_FN real2 footprintOf(MapRows map, real2 texel, real w, real3 p, real3 n, real4 step_px, real4 along)
{
    real facing = towardsPlane(n, p, along);
    real tiny = max(kEdgeOn * length(real3(along.x, along.y, along.z) - p * along.w), real(1e-30));
    facing = abs(facing) > tiny ? facing : (facing < real(0.0) ? -tiny : tiny);
    real4 d = step_px - along * (towardsPlane(n, p, step_px) / facing);
    real wd = dot(map.w, d);
    // 1 + k d.w and w + k wd may not shrink below 1 / kFarthestNeighbour of what they are at the receiver.
    real shrinks = max(-d.w, -wd / w);
    real most = real(1.0) - real(1.0) / kFarthestNeighbour;
    real k = shrinks > most ? most / shrinks : real(1.0);
    real2 moved = (real2(dot(map.x, d), dot(map.y, d)) - texel * wd) * (k / (w + k * wd));
    // NaN counts as long too.
    return length(moved) <= kLongestFootprint ? moved : real2(kLongestFootprint, real(0.0));
}

GN_END
#endif
