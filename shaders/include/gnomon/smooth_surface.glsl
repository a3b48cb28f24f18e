// SPDX-License-Identifier: Apache-2.0
// GLSL only: the smooth surface over the triangles of a smooth-shaded mesh, for MaskInputs::smooth and for
// gnomonLightVisibility(). Every other name of the library that this declares begins with gnomon or GNOMON, or GN_.
//
#ifndef GNOMON_PUBLIC_SMOOTH_SURFACE_GLSL
#define GNOMON_PUBLIC_SMOOTH_SURFACE_GLSL
#include "names_begin.glsl"
#include "shared/smooth_surface.h"

// An additional output of the vertex shader, made from the vertex's normal and its position relative to the eye, both
// in the world's axes; normals have about the same length at all vertices of a triangle. `creased`: the normal leans by
// more than some 40 degrees from that of a triangle at the vertex, as where a box's corners are shaded smoothly. Such
// triangles stay flat, or walls that face away would be lit.
float gnomonSmoothPlane(vec3 normal, vec3 point, bool creased)
{
    return smoothPlane(normal, point, creased);
}

// `point` relative to the camera's eye, metres; `normal` the triangle's unit geometric normal, towards the eye;
// `interpolated`: the vertices' normals (xyz) and that output (w). Returns the smooth surface's unit normal (xyz), and
// how far along it the surface is over the point, metres (w; -1: there is none). A normal map plays no part in it.
vec4 gnomonSmoothSurface(vec3 point, vec3 normal, vec4 interpolated)
{
    SmoothSurface s = smoothSurface(point, normal, interpolated.xyz, interpolated.w);
    return vec4(s.n, s.lift);
}

// The texel of MaskInputs::smooth for this surface, each number in [-1, 1].
vec3 gnomonSmoothEncode(vec4 smooth_surface, vec3 point)
{
    return smoothEncode(SmoothSurface(smooth_surface.xyz, smooth_surface.w), point);
}

#include "names_end.glsl"
#endif
