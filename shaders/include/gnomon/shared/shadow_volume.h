// SPDX-License-Identifier: Apache-2.0
// The shadow volume of a closed mesh: the triangles that face away from the light (light cap), the same at infinity
// away from the light (dark cap), and between them a wall along each edge where a triangle that faces away meets one
// that does not. Nowhere open, so that along every ray the faces that lead in and those that lead out tell whether a
// point is inside: there the mesh is between the point and the light. Based on: M. McGuire, J. F. Hughes, K. T. Egan,
// M. J. Kilgard, C. Everitt, "Fast, Practical and Robust Shadows", 2003; C. Everitt, M. J. Kilgard, "Practical and
// Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering", 2002.
//
// Departure: they take the triangles that face the light. Outside of the mesh both volumes are the same, for a ray that
// enters a closed mesh leaves it, too. Where light leaves the mesh there is no lit surface, so no cap lies in one and
// shades it by rounding; and a lamp inside of a mesh is shut in, as it has to be.
//
// Corners are homogeneous and relative to the eye: w = 1 is a point, w = 0 a direction, that is a point at infinity.
// Under parallel light all of these are one point: walls are triangles, and the dark cap is nothing.
#ifndef GNOMON_SHADOW_VOLUME_H
#define GNOMON_SHADOW_VOLUME_H
#include "portability.h"
GN_BEGIN

// Stands for a triangle that an edge lacks, and for the vertex opposite to the edge in it. A primitive of a closed mesh
// has such edges where another primitive of the mesh goes on.
#ifdef __cplusplus
inline constexpr unsigned kNoTriangle = 0xFFFFFFFFU;
#else
const uint kNoTriangle = 0xFFFFFFFFu;
#endif

// Two triangles are drawn for each element, an edge or a cap.
GN_CONST int kVolumeCorners = 6;

// The factor by which all of a volume is pushed away from the eye. A light cap lies in the very surface that it is made
// of, which smooth normals may have lit, so the cap has to be behind it. Rounding to single precision moves it by a
// sixteenth of that.
GN_CONST real kVolumePush = real(1.0) + real(16.0) / real(8388608.0);

// `place` of a light: w = 0: xyz is the unit direction to the light; w = 1: its position.
GN_FN real3 volumeLight(real4 place)
{
    return real3(place.x, place.y, place.z);
}

// Does the triangle, counter-clockwise seen from outside, face away from the light, so that its caps are drawn?
// `mirrored` is -1 of a mesh that is placed by a transform which mirrors, else 1. Every corner of a volume that asks
// for one triangle is to hand in its corners in the same order, so that rounding has it face the same way each time.
GN_FN bool volumeCasts(real3 a, real3 b, real3 c, real4 place, real mirrored)
{
    return dot(cross(b - a, c - a), volumeLight(place) - a * place.w) * mirrored < real(0.0);
}

// Which corner of a wall or a cap is drawn as the one of this number: a transform that mirrors turns all faces over,
// and this turns them back, so that the volumes of different meshes count the same way.
GN_FN int volumeCorner(int number, real mirrored)
{
    int k = number % 3;
    return mirrored > real(0.0) || k == 0 ? number : (k == 1 ? number + 1 : number - 1);
}

// Where a point's shadow ends: at infinity.
GN_FN real4 volumeFar(real3 p, real4 place)
{
    real3 away = p * place.w - volumeLight(place);
    return real4(away.x, away.y, away.z, real(0.0));
}

GN_FN real4 volumeNear(real3 p)
{
    return real4(p.x, p.y, p.z, real(1.0));
}

// Corner 0 to 5 of the wall along the edge from `a` to `b`, as the triangle on its left runs along it. Nothing, all
// corners in one, where both triangles cast or neither does; a triangle that there is not does not.
GN_FN real4 volumeWall(int corner, real3 a, real3 b, bool left, bool right, real4 place)
{
    if (left == right) {
        return volumeNear(a);
    }
    real3 from = left ? a : b; // so that walls face outwards, as caps do
    real3 to = left ? b : a;
    int k = corner == 3 ? 0 : (corner > 3 ? corner - 2 : corner); // corners of a quadrangle: 0 1 2, 0 2 3
    if (k == 0) {
        return volumeNear(from);
    }
    if (k == 1) {
        return volumeNear(to);
    }
    return k == 2 ? volumeFar(to, place) : volumeFar(from, place);
}

// Corner 0 to 2 of the light cap's triangle, which is turned over to face out of the volume, 3 to 5 of the dark cap's.
// Nothing where the triangle does not cast.
GN_FN real4 volumeCap(int corner, real3 a, real3 b, real3 c, bool casts, real4 place)
{
    if (!casts) {
        return volumeNear(a);
    }
    if (corner == 0 || corner == 3) {
        return corner == 0 ? volumeNear(a) : volumeFar(a, place);
    }
    bool second = corner == 2 || corner == 4;
    real3 p = second ? b : c;
    return corner < 3 ? volumeNear(p) : volumeFar(p, place);
}

GN_END
#endif
