// SPDX-License-Identifier: Apache-2.0
// GLSL only: body of the mask pass. Up to four lights of one layer of the mask, for the pixel's surface.
#include "../shared/gpu_structs.h"
#include "../shared/octahedral.h"
#include "../shared/sun_steps.h"

layout(constant_id = 0) const int kFilter = 1;      // gnomon::Filter
layout(constant_id = 1) const int kKernelWidth = 3; // see FilterInput
layout(constant_id = 2) const int kDiscTaps = 16;
layout(constant_id = 3) const bool kHasNormals = true;
// Not read from the buffer, because lavapipe executes both sides of every branch whose condition is not a constant.
layout(constant_id = 4) const int kLights = 4;
layout(constant_id = 5) const bool kManyViews = true; // some light has more views than one
layout(constant_id = 6) const bool kAutomaticBias = true;
layout(constant_id = 7) const int kMomentFlags = 0;    // see MomentRule
layout(constant_id = 8) const int kMomentSampling = 0; // gnomon::MapSampling
layout(constant_id = 9) const int kMomentLayers = 2;   // of lvsm
layout(constant_id = 10) const int kDepthHolding = 0;  // see shared/paired_depth.h
layout(constant_id = 11) const int kSteps = 0;         // bit i: light i is seen from two positions

layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuMaskLayer mask;
};
#define GNOMON_MAP_SET 0
#define GNOMON_MAP_BINDING 1
#define GNOMON_LAYERS_BINDING 5
#define GNOMON_MAP_TEXEL_SIZE mask.atlas.xy
#define GNOMON_DEPTH_HOLDING kDepthHolding
#include "map_texture.glsl"
vec2 discPoint(int i)
{
    vec4 two = mask.disc_points[i >> 1];
    return (i & 1) == 0 ? two.xy : two.zw;
}
#include "visibility.glsl"
layout(set = 0, binding = 2) uniform sampler2D depths;
layout(set = 0, binding = 3) uniform sampler2D normals;
#ifdef GNOMON_OBJECT_IDS
layout(set = 0, binding = 4) uniform usampler2D object_ids;
#endif
layout(location = 0) out vec4 visibility;

// Eye-relative position of a pixel, homogeneous.
vec4 pointAt(ivec2 pixel, float depth)
{
    vec4 ndc = vec4((vec2(pixel) + 0.5) * mask.screen.zw * 2.0 - 1.0, depth, 1.0);
    return vec4(dot(mask.eye_x, ndc), dot(mask.eye_y, ndc), dot(mask.eye_z, ndc), dot(mask.eye_w, ndc));
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
    if (any(lessThan(far, ivec2(0))) || any(greaterThanEqual(vec2(far), mask.screen.xy))) {
        return vec3(depth, depth, 3e38);
    }
    float a = texelFetch(depths, pixel + step_px, 0).r;
    float b = texelFetch(depths, far, 0).r;
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

vec3 normalFromDepth(ivec2 pixel, float depth, vec3 p)
{
    vec3 n = cross(tangentFromDepth(pixel, ivec2(1, 0), depth, p), tangentFromDepth(pixel, ivec2(0, 1), depth, p));
    float l = length(n);
    n = l > 0.0 ? n / l : normalize(-p);
    return dot(n, p) > 0.0 ? -n : n; // towards the eye
}

FilterInput filterInput()
{
    FilterInput f;
    f.layer = 0.0;
    f.part = 0.0;
    f.kernel_width = kKernelWidth;
    f.disc_taps = kDiscTaps;
    f.disc_radius = mask.disc.x;
    f.kernel = mask.kernel;
    f.pixel = gl_FragCoord.xy;
    f.moments = momentsOf(kMomentFlags, kMomentSampling, kMomentLayers, mask.moment_warp, mask.moment_variance,
                          mask.moment_shape);
    return f;
}

// What the views of one position of a light say so far. They are in the order in which they fade over into each other.
struct Seen {
    float v;
    bool found;
};

// `index` is a constant at every call, so that the first view, too, is at a constant place.
Seen firstView(int index, float depth, BiasRule bias, PixelSteps steps, vec3 p, vec3 n)
{
    Seen seen = Seen(1.0, viewContains(mask.views[index], p, depth));
    if (seen.found) {
        seen.v = viewVisibility(kFilter, mask.views[index], bias, filterInput(), steps, p, n);
    }
    return seen;
}

Seen furtherView(uint i, Seen seen, float depth, BiasRule bias, PixelSteps steps, vec3 p, vec3 n)
{
    float share = seen.found ? viewShare(mask.views[i], depth) : 1.0;
    if (share > 0.0 && viewContains(mask.views[i], p, depth)) {
        seen.v = mix(seen.v, viewVisibility(kFilter, mask.views[i], bias, filterInput(), steps, p, n), share);
        seen.found = true;
    }
    return seen;
}

// `index` is a constant at every call.
float lightVisibility(int index, PixelSteps steps, vec3 p, vec3 n)
{
    GpuLight light = mask.lights[index];
    BiasRule bias = biasOf(mask.bias, mask.bias_more);
    bias.automatic = kAutomaticBias ? 1.0 : 0.0;
#ifdef GNOMON_STEPPING
    const bool paired = (kSteps & (1 << index)) != 0;
#else
    const bool paired = false; // else every pipeline would be compiled from half as much code again
#endif
    float depth = dot(mask.view_axis.xyz, p);
    Seen seen = firstView(index, depth, bias, steps, p, n);
    Seen later = Seen(1.0, false);
    if (paired) {
        later = firstView(kLightsPerLayer + index, depth, bias, steps, p, n);
    }
    if (kManyViews) {
        uint middle = light.views.x + light.views.y;
        uint end = middle + (paired ? light.views.w : 0);
        for (uint i = light.views.x; i < end; ++i) {
            if (paired && i == middle) { // what is done of the earlier position goes to `later` until the end
                Seen earlier = seen;
                seen = later;
                later = earlier;
            }
            seen = furtherView(i, seen, depth, bias, steps, p, n);
        }
        if (paired && end > middle) {
            Seen earlier = later;
            later = seen;
            seen = earlier;
        }
    }
    float v = seen.v;
    if (paired) {
        v = steppedVisibility(v, later.v, stepWeight(mask.steps[index], gl_FragCoord.x * mask.screen.z));
    }
    v = fadedVisibility(mask.fade, v, length(p));
    return light.views.z == 0 ? 1.0 : (facesLight(light, p, n) ? v : 0.0);
}

void main()
{
    visibility = vec4(1.0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).r;
    if (depth == mask.atlas.z) {
        return;
    }
#ifdef GNOMON_OBJECT_IDS
    if (texelFetch(object_ids, pixel, 0).r == 0) {
        return;
    }
#endif
    vec4 h = pointAt(pixel, depth);
    vec3 p = h.xyz / h.w;
    PixelSteps steps = pixelSteps(mask.eye_x, mask.eye_y, mask.eye_z, mask.eye_w, h.w, 2.0 * mask.screen.zw);
    vec3 n = kHasNormals ? octahedralDecode(texelFetch(normals, pixel, 0).rg) : normalFromDepth(pixel, depth, p);
    visibility.r = lightVisibility(0, steps, p, n);
    if (kLights > 1) {
        visibility.g = lightVisibility(1, steps, p, n);
    }
    if (kLights > 2) {
        visibility.b = lightVisibility(2, steps, p, n);
    }
    if (kLights > 3) {
        visibility.a = lightVisibility(3, steps, p, n);
    }
}
