#version 460
// SPDX-License-Identifier: Apache-2.0
// soften=blur: takes a layer of the mask from an image of the same or of a smaller size. Where edges count it is read
// between those texels that stand for pixels of the same surface; where there are none, the mask stays as it was.
// Based on: J. Kopf, M. Cohen, D. Lischinski, M. Uyttendaele, "Joint Bilateral Upsampling", SIGGRAPH 2007.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/soften_surface.glsl"
#include "gnomon/shared/mask_upsample.h"

layout(location = 0) out vec4 visibility;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    visibility = vec4(1.0);
    if (kScale == 1) {
        visibility = sourceTexel(pixel);
        return;
    }
    if (!kEdgeAware) {
        visibility = sourceAt((vec2(pixel) + 0.5) / float(kScale));
        return;
    }
    float depth = GNOMON_SCREEN_TEXEL(depths, pixel).r;
    if (depth == gnomon.screen.fade.z) {
        discard;
    }
    Surface surface = surfaceAt(pixel, depth);
    vec2 place = vec2(texelOfPixel(pixel.x, kScale), texelOfPixel(pixel.y, kScale));
    vec2 cell = floor(place);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = clamp(ivec2(cell) + ivec2(i & 1, i >> 1), ivec2(0), push.sizes.xy - 1);
        float weight = cornerShare(place - cell, i) * shareOf(surface, pixelsOf(texel, kScale));
        sum += weight * sourceTexel(texel);
        weights += weight;
    }
    if (weights <= 0.01) {
        discard;
    }
    visibility = sum / weights;
}
