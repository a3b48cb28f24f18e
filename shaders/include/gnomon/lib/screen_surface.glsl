// SPDX-License-Identifier: Apache-2.0
// GLSL only: the surface that a pixel shows, from the camera's depth. The includer has a sampler2D `depths`, and defines
// GNOMON_SURFACE_SCREEN, a GpuScreen.
#ifndef GNOMON_SCREEN_SURFACE_GLSL
#define GNOMON_SCREEN_SURFACE_GLSL

// A texel of an image that is as large as the screen. A pass whose samplers are nearest and that is drawn in
// software may define GNOMON_SURFACE_SAMPLED, a constant [drivers: mip].
#ifndef GNOMON_SURFACE_SAMPLED
#define GNOMON_SURFACE_SAMPLED false
#endif
#define GNOMON_SCREEN_TEXEL(IMAGE, PIXEL)                                                                              \
    (GNOMON_SURFACE_SAMPLED ? textureLod(IMAGE, (vec2(PIXEL) + 0.5) * GNOMON_SURFACE_SCREEN.size.zw, 0.0)              \
                            : texelFetch(IMAGE, PIXEL, 0))

// Eye-relative position of a pixel, homogeneous.
vec4 pointAt(ivec2 pixel, float depth)
{
    vec4 ndc = vec4((vec2(pixel) + 0.5) * GNOMON_SURFACE_SCREEN.size.zw * 2.0 - 1.0, depth, 1.0);
    return vec4(dot(GNOMON_SURFACE_SCREEN.eye_x, ndc), dot(GNOMON_SURFACE_SCREEN.eye_y, ndc), dot(GNOMON_SURFACE_SCREEN.eye_z, ndc), dot(GNOMON_SURFACE_SCREEN.eye_w, ndc));
}

vec3 positionAt(ivec2 pixel, float depth)
{
    vec4 p = pointAt(pixel, depth);
    return p.xyz / p.w;
}

// The two pixels on one side. x, y: their depths; z: how far the pixel is off the line through them.
vec3 side(ivec2 pixel, ivec2 step_px, float depth)
{
    ivec2 far = pixel + 2 * step_px;
    if (any(lessThan(far, ivec2(0))) || any(greaterThanEqual(vec2(far), GNOMON_SURFACE_SCREEN.size.xy))) {
        return vec3(depth, depth, 3e38);
    }
    float a = GNOMON_SCREEN_TEXEL(depths, pixel + step_px).r;
    float b = GNOMON_SCREEN_TEXEL(depths, far).r;
    return vec3(a, b, abs(2.0 * a - b - depth));
}

// Along one axis of the screen, towards positive coordinates. A plane's depth is affine on the screen, so the side
// where the pixel continues its neighbours' line is on the pixel's own surface. Based on: Y. Wu (atyuwen), "Accurate
// Normal Reconstruction from Depth Buffer", 2021.
vec3 tangentFromDepth(ivec2 pixel, ivec2 step_px, float depth, vec3 p)
{
    vec3 before = side(pixel, -step_px, depth);
    vec3 after = side(pixel, step_px, depth);
    return before.z < after.z ? p - positionAt(pixel - step_px, before.x) : positionAt(pixel + step_px, after.x) - p;
}

// The way from the eye through a pixel's point, of any length. Where w does not change with depth the camera is
// orthographic, and depth tells which way that is.
vec3 sightTo(vec3 p)
{
    float away = GNOMON_SURFACE_SCREEN.fade.z * 2.0 - 1.0; // depth at the far end is 0 or 1
    return GNOMON_SURFACE_SCREEN.eye_w.z != 0.0
               ? p
               : vec3(GNOMON_SURFACE_SCREEN.eye_x.z, GNOMON_SURFACE_SCREEN.eye_y.z, GNOMON_SURFACE_SCREEN.eye_z.z) * away;
}

vec3 normalFromDepth(ivec2 pixel, float depth, vec3 p)
{
    // Tangents as shares of the distance, which no size of the scene changes.
    float k = inversesqrt(dot(p, p));
    vec3 n = cross(tangentFromDepth(pixel, ivec2(1, 0), depth, p) * k, tangentFromDepth(pixel, ivec2(0, 1), depth, p) * k);
    float l = length(n);
    vec3 sight = sightTo(p);
    n = l > 0.0 ? n / l : normalize(-sight);
    return dot(n, sight) > 0.0 ? -n : n; // towards the eye
}

#endif
