// SPDX-License-Identifier: Apache-2.0
// The map of a half space around a light: where it has a direction, and where a receiver is on it.
// Based on: S. Brabec, T. Annen, H.-P. Seidel, "Shadow Mapping for Hemispherical and Omnidirectional Light Sources",
// CGI 2002.
#ifndef GNOMON_PARABOLOID_H
#define GNOMON_PARABOLOID_H
#include "bias.h"
GN_BEGIN

// A point straight behind has no place. Within some 4 degrees of that direction, places are kept finite.
GN_CONST real kParaboloidBehind = real(0.001953125);

// From the light, q.z along the map's axis. In front of the light the place is in the unit disc, on the axis its
// middle: tan(angle / 2) from there.
GN_FN real2 paraboloidPlace(real3 q)
{
    real l = length(q);
    real s = max(max(q.z + l, l * kParaboloidBehind), real(1e-30));
    return real2(q.x, q.y) / s;
}

// Unit: the inverse of paraboloidPlace().
GN_FN real3 paraboloidDirection(real2 place)
{
    real r2 = dot(place, place);
    return real3(real(2.0) * place.x, real(2.0) * place.y, real(1.0) - r2) / (real(1.0) + r2);
}

// Rows that are exact at `p` and to the first order beside it, so that code that reads a map by its rows can read this
// one: those of the perspective map whose axis is the ray to `p`. Along a surface that the light grazes depth is far
// from a straight line, and a perspective map's rows know. `map` has in x, y and w rows that take a point to q, in
// lengths of far - near, and in metric.w minus near in these. `places`: xy: how many texels a place of 1 is from the
// disc's middle, zw: where that is. Depth is the distance from the light.
GN_FN MapRows paraboloidRows(MapRows map, real4 places, real3 p)
{
    real3 gx = gradientOf(map.x);
    real3 gy = gradientOf(map.y);
    real3 gz = gradientOf(map.w);
    real3 q = real3(dotRow(map.x, p), dotRow(map.y, p), dotRow(map.w, p));
    real l = max(length(q), real(1e-30));
    real s = max(q.z + l, l * kParaboloidBehind);
    real3 gl = (gx * q.x + gy * q.y + gz * q.z) / l;
    // d(q.x / s) = (dq.x - q.x / s ds) / s, ds = dq.z + dl.
    real3 gs = gz + gl;
    real2 place = real2(q.x, q.y) / s;
    real3 across = (gx - gs * place.x) * (places.x * l / s);
    real3 down = (gy - gs * place.y) * (places.y * l / s);
    MapRows rows = map;
    rows.w = real4(gl, l - dot(gl, p));
    rows.x = real4(across, -dot(across, p)) + rows.w * (place.x * places.x + places.z);
    rows.y = real4(down, -dot(down, p)) + rows.w * (place.y * places.y + places.w);
    rows.metric = real4(gl, rows.w.w + map.metric.w);
    return rows;
}

GN_END
#endif
