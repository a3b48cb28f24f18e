// SPDX-License-Identifier: Apache-2.0
// The smooth surface that a mesh's normals describe, over its flat triangles: it places the terminator of a
// smooth-shaded mesh, and the points that take its light.
// Based on: J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021. Departure: he moves a point onto the
// planes of the three vertices, each perpendicular to its normal, and interpolates the three points. We interpolate
// the planes and move the point onto the one that results, along its normal. For normals a few degrees apart both are
// the same to second order, and ours needs one interpolated number beside the normal, so every rasteriser has it. For a
// ball whose vertices have the ball's normals it is exactly the inverse point, at R^2 / |p| from the centre, from which
// no ray above the horizon meets the ball.
#ifndef GNOMON_SMOOTH_SURFACE_H
#define GNOMON_SMOOTH_SURFACE_H
#include "octahedral.h"
GN_BEGIN

struct SmoothSurface {
    real3 n;   // unit, interpolated between the vertices, on the side of the triangle's normal
    real lift; // metres along n from the triangle to the smooth surface, > 0; below 0: there is none over it
};

// Below this distance between its two unit normals a surface is flat: normals are stored in 16 bits, and files hold
// flat ones that were rounded.
GN_CONST real kFlat = real(0.004);

// Lifts are nothing below this share of the distance from the eye, a five hundredth of a pixel or so: interpolation's
// rounding. Cards of foliage, say, have one normal at all corners that is not their own. They are flat.
GN_CONST real kLeastLift = real(2e-6);

// A lift that is no shorter than the distance from the eye comes of a creased corner.
GN_CONST real kMostLift = real(1.0);

// Where triangles are the surface: flat ones, hollows, and hosts that have no interpolated normals.
GN_FN SmoothSurface flatSurface(real3 n)
{
    SmoothSurface s;
    s.n = n;
    s.lift = real(-1.0);
    return s;
}

// For a vertex at `v` with normal `m`: the plane's distance, times the normal's length. `creased`: the normal smooths
// over a real edge, as at a box's corners; then no triangle of this vertex has a smooth surface over it.
GN_FN real smoothPlane(real3 m, real3 v, bool creased)
{
    return dot(m, v) + (creased ? real(1e4) * length(m) * length(v) : real(0.0));
}

// The smooth surface over the point `p` of a triangle with unit normal `n`. Two inputs are interpolated between its
// vertices v with normals m, all of about one length: `normal`: m; `plane`: smoothPlane(m, v). p and v are relative to
// the eye.
//
// Derivation. The vertices' planes are dot(m, x) = dot(m, v); interpolated, dot(normal, x) = plane. p + t normal is on
// it where t = (plane - dot(normal, p)) / dot(normal, normal), and that is t |normal| away.
GN_FN SmoothSurface smoothSurface(real3 p, real3 n, real3 normal, real plane)
{
    real l = length(normal);
    if (!(l > real(0.0))) {
        return flatSurface(n);
    }
    real side = dot(normal, n) < real(0.0) ? real(-1.0) : real(1.0);
    SmoothSurface s;
    s.n = normal * (side / l);
    s.lift = side * (plane - dot(normal, p)) / l;
    real share = s.lift / length(p);
    if (!(share > kLeastLift && share < kMostLift) || length(s.n - n) < kFlat) {
        return flatSurface(n);
    }
    return s;
}

// The last of the three numbers of smoothEncode(), where `unit` is the interpolated normal's direction already, on the
// side of `n`: what smoothSurface() finds, by one division less.
GN_FN real smoothLift(real3 p, real3 n, real3 unit, real3 normal, real plane)
{
    real share = (plane - dot(normal, p)) / (dot(unit, normal) * length(p));
    bool is_flat = !(share > kLeastLift && share < kMostLift) || length(unit - n) < kFlat;
    return is_flat ? real(0.0) : sqrt(share);
}

// The texel of MaskInputs::smooth, each number in [-1, 1]: the normal, octahedral, and the root of the lift as a share
// of the distance from the eye, 0 where there is none; so 16 bits are enough for every size of scene.
GN_FN real3 smoothEncode(SmoothSurface s, real3 p)
{
    real2 e = octahedralEncode(s.n);
    return real3(e.x, e.y, sqrt(clamp(s.lift / length(p), real(0.0), real(1.0))));
}
GN_FN SmoothSurface smoothDecode(real3 e, real3 p, real3 n)
{
    if (!(e.z > real(0.0))) {
        return flatSurface(n);
    }
    SmoothSurface s;
    s.n = octahedralDecode(real2(e.x, e.y));
    s.lift = e.z * e.z * length(p);
    return s;
}

GN_END
#endif
