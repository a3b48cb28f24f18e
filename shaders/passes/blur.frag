#version 460
// SPDX-License-Identifier: Apache-2.0
// One direction of a separable blur, a pixel at a time: two texels with one filtered read where they may be added.
#extension GL_GOOGLE_include_directive : require
#define GN_FRAGMENT
#include "../lib/filter_pass.glsl"

layout(location = 0) out vec4 blurred;

const ivec2 kAxisVector = ivec2(1 - kAxis, kAxis);

vec4 sourceAt(ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), place.size.xy - 1);
    return texelFetch(source_image, ivec3(place.source.xy + inside, place.source.z), 0);
}

// At a place between texels of the tile, in texels.
vec4 sourceBetween(vec2 texel)
{
    vec2 inside = clamp(texel, vec2(0.5), vec2(place.size.xy) - 0.5);
    vec2 uv = (vec2(place.source.xy) + inside) / vec2(textureSize(source_image, 0).xy);
    return textureLod(source_image, vec3(uv, float(place.source.z)), 0.0);
}

// A filtered read touches the texels beside its place, too, if only with the weight 0. Beyond the edges of a block, across
// the direction, and of the tile these may be what nobody wrote: 0 times what is not a number is not 0.
bool isNearEdge(ivec2 texel)
{
    int across = kAxis == 0 ? texel.y : texel.x;
    int along = kAxis == 0 ? texel.x : texel.y;
    int last_across = (kAxis == 0 ? place.size.y : place.size.x) - 1;
    int last_along = (kAxis == 0 ? place.size.x : place.size.y) - 1;
    int in_block = across % kBlockTexels;
    return in_block == 0 || in_block == kBlockTexels - 1 || across == last_across || along <= kRadius ||
           along >= last_along - kRadius;
}

vec4 blurOneByOne(ivec2 texel)
{
    vec4 total = vec4(0.0);
    for (int i = -kRadius; i <= kRadius; ++i) {
        total += sourceAt(texel + i * kAxisVector) * kernel.weight[abs(i)].x;
    }
    return total;
}

vec4 blurValues(ivec2 texel)
{
    if (isNearEdge(texel)) {
        return blurOneByOne(texel);
    }
    vec4 total = sourceAt(texel) * kernel.weight[0].z;
    vec2 centre = vec2(texel) + 0.5;
    for (int i = 1; i <= (kRadius + 1) / 2; ++i) {
        vec2 away = vec2(kAxisVector) * kernel.weight[i].y;
        total += (sourceBetween(centre + away) + sourceBetween(centre - away)) * kernel.weight[i].z;
    }
    return total;
}

vec4 blurLogarithms(ivec2 texel)
{
    vec4 k = averageExponents(kFilter, momentRule());
    MomentSum sum = startAverage(sourceAt(texel - kRadius * kAxisVector), kernel.weight[kRadius].x, true);
    for (int i = 1 - kRadius; i <= kRadius; ++i) {
        sum = addToAverage(sum, sourceAt(texel + i * kAxisVector), kernel.weight[abs(i)].x, k, true);
    }
    return finishAverage(sum, k, true);
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy) - place.target.xy;
    ivec2 block = texel / kBlockTexels;
    uint work = blocks[block.y * place.size.z + block.x];
    if ((work & (kAxis == 0 ? kBlurX : kBlurY)) != 0u) {
        blurred = averagesLogs() ? blurLogarithms(texel) : blurValues(texel);
    } else if (kAxis == 0 && (work & kFillX) != 0u) {
        blurred = sourceAt(texel);
    } else {
        discard; // what is there already is right, or nobody reads it
    }
}
