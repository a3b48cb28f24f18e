// SPDX-License-Identifier: Apache-2.0
// Images of ambient occlusion. They have half the picture's size, and a texel more. One texel holds the view depth, of
// which 15 bits of mantissa are left, and what is seen of the sky in its last byte: one gather reads four of both.
#ifndef HOST_OCCLUSION_TEXEL_GLSL
#define HOST_OCCLUSION_TEXEL_GLSL

uint packSeen(float view_depth, float seen)
{
    return (floatBitsToUint(view_depth) & ~255u) | uint(clamp(seen, 0.0, 1.0) * 255.0 + 0.5);
}
vec4 seenOfTexels(uvec4 texels) { return vec4(texels & 255u) / 255.0; }
vec4 depthOfTexels(uvec4 texels) { return uintBitsToFloat(texels & ~255u); }

// Weights of four texels by how far what they saw lies from the surface at `p`. `x`, `y`: places of their pixels'
// middles; `tolerance`: metres.
vec4 surfaceWeights(vec3 p, vec3 normal, vec4 x, vec4 y, vec4 view_depths, float tolerance)
{
    vec4 along = dot(normal, FRAME_RAY_X.xyz) * x + dot(normal, FRAME_RAY_Y.xyz) * y + dot(normal, FRAME_RAY_0.xyz);
    vec4 at = isOrthographic() ? along + dot(normal, viewAxis()) * view_depths : along * view_depths;
    vec4 off = abs(at - dot(normal, p)) / tolerance;
    vec4 near = max(1.0 - off, 0.0);
    return near * near + 1e-3; // where all lie off it, their mean
}

// Metres that two texels of one surface may lie apart.
float surfaceTolerance(float view_depth)
{
    return max(0.2 * FRAME_RAY_X.w, 2.0 * pixelAt(view_depth));
}

#endif
