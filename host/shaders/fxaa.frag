// SPDX-License-Identifier: Apache-2.0
// Smooths edges in the finished picture: where the luma around a pixel differs, blur along the edge.
// Based on: T. Lottes, "FXAA", NVIDIA white paper, 2009 (the short-range form: direction from the four diagonal
// neighbours' luma, two taps near and two far along it, the far ones taken only where they stay in the local range).
#version 460

layout(set = 0, binding = 6) uniform sampler2D picture; // linear filter, clamped; alpha: luma
layout(location = 0) out vec4 out_colour;

const float kLeastContrast = 1.0 / 24.0;    // of full range: what is flatter stays
const float kContrastShare = 1.0 / 8.0;     // of the local maximum
const float kReachTexels = 8.0;

void main()
{
    ivec2 last = textureSize(picture, 0) - 1;
    vec2 texel = 1.0 / vec2(last + 1);
    vec2 uv = gl_FragCoord.xy * texel;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 before = max(pixel - 1, ivec2(0));
    ivec2 after = min(pixel + 1, last);
    vec4 centre = texelFetch(picture, pixel, 0);
    float nw = texelFetch(picture, before, 0).a;
    float ne = texelFetch(picture, ivec2(after.x, before.y), 0).a;
    float sw = texelFetch(picture, ivec2(before.x, after.y), 0).a;
    float se = texelFetch(picture, after, 0).a;
    float low = min(centre.a, min(min(nw, ne), min(sw, se)));
    float high = max(centre.a, max(max(nw, ne), max(sw, se)));
    out_colour = vec4(centre.rgb, 1.0);
    if (high - low < max(kLeastContrast, high * kContrastShare)) {
        return;
    }
    // Along the edge: across the gradient of the luma.
    vec2 along = vec2(-((nw + ne) - (sw + se)), (nw + sw) - (ne + se));
    float least = max((nw + ne + sw + se) * (0.25 / 8.0), 1.0 / 128.0);
    along = clamp(along / (min(abs(along.x), abs(along.y)) + least), -kReachTexels, kReachTexels) * texel;
    vec4 near = 0.5 * (textureLod(picture, uv - along / 6.0, 0.0) + textureLod(picture, uv + along / 6.0, 0.0));
    vec4 far = 0.5 * near + 0.25 * (textureLod(picture, uv - along * 0.5, 0.0) + textureLod(picture, uv + along * 0.5, 0.0));
    out_colour.rgb = far.a < low || far.a > high ? near.rgb : far.rgb;
}
