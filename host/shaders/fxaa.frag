// SPDX-License-Identifier: Apache-2.0
// Smooths edges in the finished picture: where the luma around a pixel differs, the edge is followed to both its ends,
// and how near the next one is says how much of the pixel beyond it belongs to this one.
// Based on: T. Lottes, "FXAA 3.11", NVIDIA 2011, its quality form.
#version 460

layout(set = 0, binding = 6) uniform sampler2D picture; // linear filter, clamped; alpha: luma
layout(location = 0) out vec4 out_colour;

const float kLeastContrast = 1.0 / 24.0; // share of full range: flatter places stay
const float kContrastShare = 1.0 / 8.0;  // share of the local maximum
const float kSubpixel = 0.5;             // how much single pixels that stand out are smoothed
const int kStrides = 8;
const float kStride[kStrides] = float[](1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 4.0, 8.0); // pixels

float lumaAt(vec2 place) { return textureLod(picture, place, 0.0).a; }

// From between the edge's two rows along it until their mean differs from the edge's: how far that is in pixels, and
// the difference there.
vec2 edgeEnd(vec2 place, vec2 along, float mean, float enough)
{
    float distance = 0.0;
    float difference = 0.0;
    for (int i = 0; i < kStrides && abs(difference) < enough; ++i) {
        distance += kStride[i];
        difference = lumaAt(place + along * distance) - mean;
    }
    return vec2(distance, difference);
}

// How far along a row the pixel reads beyond the edge, in pixels: half of one at the edge's end, none in its middle.
float edgeOffset(vec2 before, vec2 after, float own_difference)
{
    vec2 nearest = before.x < after.x ? before : after;
    bool ends_here = (nearest.y < 0.0) != (own_difference < 0.0); // the edge steps towards this pixel
    return ends_here ? 0.5 - nearest.x / (before.x + after.x) : 0.0;
}

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(picture, 0));
    vec2 uv = gl_FragCoord.xy * texel;
    vec4 centre = textureLod(picture, uv, 0.0);
    out_colour = vec4(centre.rgb, 1.0);
    // One gather reads the pixel and three neighbours: x is below, z to the upper right.
    vec4 upper_left = textureGather(picture, uv - 0.5 * texel, 3);
    vec4 lower_right = textureGather(picture, uv + 0.5 * texel, 3);
    float m = centre.a;
    float n = upper_left.z;
    float w = upper_left.x;
    float e = lower_right.z;
    float s = lower_right.x;
    float high = max(m, max(max(n, s), max(w, e)));
    float range = high - min(m, min(min(n, s), min(w, e)));
    if (range < max(kLeastContrast, high * kContrastShare)) {
        return;
    }
    float nw = upper_left.w;
    float se = lower_right.y;
    float ne = lumaAt(uv + texel * vec2(1.0, -1.0));
    float sw = lumaAt(uv + texel * vec2(-1.0, 1.0));
    float across_rows = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
    float across_columns = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
    bool level = across_rows >= across_columns;
    // The neighbour on the other side of the edge.
    float first = level ? n : w;
    float second = level ? s : e;
    bool is_first = abs(first - m) >= abs(second - m);
    float other = is_first ? first : second;
    vec2 over = (level ? vec2(0.0, texel.y) : vec2(texel.x, 0.0)) * (is_first ? -1.0 : 1.0);
    vec2 along = level ? vec2(texel.x, 0.0) : vec2(0.0, texel.y);
    float mean = 0.5 * (m + other);
    float enough = 0.25 * abs(other - m);
    vec2 before = edgeEnd(uv + 0.5 * over, -along, mean, enough);
    vec2 after = edgeEnd(uv + 0.5 * over, along, mean, enough);
    // A pixel that stands out from all its neighbours.
    float stands_out = clamp(abs((2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0 - m) / range, 0.0, 1.0);
    float smoothed = (3.0 - 2.0 * stands_out) * stands_out * stands_out;
    float offset = max(edgeOffset(before, after, m - mean), kSubpixel * smoothed * smoothed);
    out_colour.rgb = textureLod(picture, uv + over * offset, 0.0).rgb;
}
