#version 460
// SPDX-License-Identifier: Apache-2.0
// The camera's depth, into a buffer that has a stencil beside it. Where a smooth surface lies over the triangles it is
// that surface's depth, which no volume of a convex body's own triangles reaches: so its terminator is smooth.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/gpu_structs.h"
#include "gnomon/shared/smooth_surface.h"

layout(constant_id = 0) const bool kHasSmooth = false; // smooth_surfaces is no stand-in
layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants constants;
};
layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 3) uniform sampler2D smooth_surfaces;

#define GNOMON_SURFACE_SCREEN constants.screen
#include "gnomon/lib/screen_surface.glsl"

// Least cosine for a surface seen edge-on. It limits the shift along the line of sight to 1 / 0.2 lifts.
const float kLeastCosine = 0.2;

// Along a pixel's line of sight the homogeneous point's xyz is the same at every depth, and w is affine in it: the point
// at k times the distance has w / k. An orthographic camera has no such w, and keeps its depth.
float liftedDepth(ivec2 pixel, float depth)
{
    vec4 h = pointAt(pixel, depth);
    vec3 p = h.xyz / h.w;
    SmoothSurface s = smoothDecode(texelFetch(smooth_surfaces, pixel, 0).rgb, p, vec3(0.0));
    float slope = constants.screen.eye_w.z;
    if (!(s.lift > 0.0) || slope == 0.0) {
        return depth;
    }
    float far = length(p);
    float k = 1.0 - s.lift / (max(-dot(s.n, p) / far, kLeastCosine) * far);
    return k > 0.5 ? depth + h.w * (1.0 / k - 1.0) / slope : depth;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).r;
    gl_FragDepth = kHasSmooth && depth != constants.screen.fade.z ? liftedDepth(pixel, depth) : depth;
}
