#version 460
// SPDX-License-Identifier: Apache-2.0
// soften=blur: one pass of the blur of a layer of the mask, four lights at a time. gnomon/shared/screen_blur.h has the source.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/discs.h"
#include "gnomon/lib/soften_surface.glsl"

layout(location = 0) out vec4 visibility;

vec2 diskPoint(int i)
{
    vec4 two = points[i >> 1];
    return (i & 1) == 0 ? two.xy : two.zw;
}

// Where tap i is, in pixels from the middle, and in z what it weighs.
vec3 tapAt(int i, vec2 turn)
{
    if (kKernel == kScreenPoisson) {
        vec2 at = diskPoint(i);
        return vec3(vec2(at.x * turn.x - at.y * turn.y, at.x * turn.y + at.y * turn.x) * push.along.z, 1.0);
    }
    if (kKernel == kScreenPublished) {
        return vec3(push.along.xy * (publishedPlace(i) * push.along.z), publishedWeight(i));
    }
    int from_middle = i - screenTapsAside(kScale);
    return vec3(push.along.xy * (screenTapPlace(from_middle, kScale) * push.along.z),
                screenTapWeight(kKernel, from_middle, kScale));
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float per_px = 1.0 / float(push.how.x);
    float angle = kKernel == kScreenPoisson ? interleavedGradientNoise(gl_FragCoord.xy) * 6.2831853 : 0.0;
    vec2 turn = vec2(cos(angle), sin(angle)) * kScreenDiscRadius;
    int taps = kKernel == kScreenPoisson     ? push.how.z
               : kKernel == kScreenPublished ? kPublishedTaps
                                             : 2 * screenTapsAside(kScale) + 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    if (!kEdgeAware) {
        vec2 middle = (vec2(texel) + 0.5) * float(kScale) * per_px;
        for (int i = 0; i < taps; ++i) {
            vec3 tap = tapAt(i, turn);
            sum += tap.z * sourceAt(middle + tap.xy * per_px);
            weights += tap.z;
        }
        visibility = kKernel == kScreenPublished ? sum : sum / weights;
        return;
    }
    ivec2 pixel = pixelsOf(texel, kScale);
    ivec2 middle = push.how.x == 1 ? pixel : texel;
    float depth = GNOMON_SCREEN_TEXEL(depths, pixel).r;
    if (depth == gnomon.screen.fade.z) { // the background
        visibility = sourceTexel(middle);
        return;
    }
    Surface surface = surfaceAt(pixel, depth);
    for (int i = 0; i < taps; ++i) {
        vec3 tap = tapAt(i, turn);
        ivec2 off = ivec2(nearestPixel(tap.x * per_px), nearestPixel(tap.y * per_px));
        ivec2 there = clamp(middle + off, ivec2(0), push.sizes.xy - 1);
        float weight = tap.z * shareOf(surface, push.how.x == 1 ? there : pixelsOf(there, kScale));
        sum += weight * sourceTexel(there);
        weights += weight;
    }
    // The middle tap is the pixel itself; a disc has none.
    visibility = weights > 1e-3 ? sum / weights : sourceTexel(middle);
}
