// SPDX-License-Identifier: Apache-2.0
// GLSL only: whether two pixels show the same surface. The includer has samplers `depths` and `normals` of the screen's
// size and a constant kHasNormals, and defines GNOMON_SURFACE_SCREEN as for screen_surface.glsl.
#ifndef GNOMON_SURFACE_SHARE_GLSL
#define GNOMON_SURFACE_SHARE_GLSL
#include "../shared/octahedral.h"
#include "../shared/screen_blur.h"
#include "screen_surface.glsl"

// A pixel's plane. Depth is affine on the screen, so a point is on it where dot(plane, ndc) / dot(eye_w, ndc) = at.
struct Surface {
    vec4 plane;
    float at;
    float px_per_m;
    vec3 n;
};

Surface surfaceAt(ivec2 pixel, float depth)
{
    vec4 h = pointAt(pixel, depth);
    vec3 p = h.xyz / h.w;
    Surface s;
    s.n = kHasNormals ? octahedralDecode(GNOMON_SCREEN_TEXEL(normals, pixel).rg) : normalFromDepth(pixel, depth, p);
    s.plane = s.n.x * GNOMON_SURFACE_SCREEN.eye_x + s.n.y * GNOMON_SURFACE_SCREEN.eye_y + s.n.z * GNOMON_SURFACE_SCREEN.eye_z;
    s.at = dot(s.n, p);
    vec3 right = vec3(GNOMON_SURFACE_SCREEN.eye_x.x, GNOMON_SURFACE_SCREEN.eye_y.x, GNOMON_SURFACE_SCREEN.eye_z.x) * (2.0 * GNOMON_SURFACE_SCREEN.size.z);
    s.px_per_m = abs(h.w) / length(right);
    return s;
}

// The weight of another pixel: 0 .. 1.
float shareOf(Surface s, ivec2 pixel)
{
    float depth = GNOMON_SCREEN_TEXEL(depths, pixel).r;
    vec4 ndc = vec4((vec2(pixel) + 0.5) * GNOMON_SURFACE_SCREEN.size.zw * 2.0 - 1.0, depth, 1.0);
    float off = abs(dot(s.plane, ndc) / dot(GNOMON_SURFACE_SCREEN.eye_w, ndc) - s.at) * s.px_per_m;
    float share = screenDepthShare(off);
    if (kHasNormals) {
        share *= screenNormalShare(dot(s.n, octahedralDecode(GNOMON_SCREEN_TEXEL(normals, pixel).rg)));
    }
    return depth == GNOMON_SURFACE_SCREEN.fade.z ? 0.0 : share;
}

#endif
