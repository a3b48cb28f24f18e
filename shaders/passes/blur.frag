#version 460
// SPDX-License-Identifier: Apache-2.0
// The second direction of a blur, along y, from the scratch image into the map, a pixel at a time: two texels with one
// filtered read where they may be added. The tile's outermost texels hold what is lit, and so does everything outside.
#extension GL_GOOGLE_include_directive : require
#define GN_FRAGMENT
#include "gnomon/lib/encoders.glsl"
#include "gnomon/lib/scratch.glsl"

layout(location = 0) out vec4 blurred;

vec4 blurValues(ivec3 column, int y)
{
    float last = float(place.size.y) - 0.5;
    vec3 scale = vec3(1.0 / vec2(textureSize(source_image, 0).xy), 1.0);
    vec3 middle = vec3(float(column.x) + 0.5, float(y) + 0.5, float(column.z));
    vec4 total = textureLod(source_image, middle * scale, 0.0) * kernel.weight[0].z;
    for (int i = 1; i <= (kRadius + 1) / 2; ++i) {
        float away = kernel.weight[i].y;
        vec3 before = vec3(middle.x, max(middle.y - away, 0.5), middle.z);
        vec3 after = vec3(middle.x, min(middle.y + away, last), middle.z);
        total += (textureLod(source_image, before * scale, 0.0) + textureLod(source_image, after * scale, 0.0)) *
                 kernel.weight[i].z;
    }
    return total;
}

vec4 sourceAt(ivec3 column, int y)
{
    return texelFetch(source_image, column + ivec3(0, clamp(y, 0, place.size.y - 1), 0), 0);
}

vec4 blurLogarithms(ivec3 column, int y)
{
    vec4 k = averageExponents(kFilter, momentRule());
    MomentSum sum = startAverage(sourceAt(column, y - kRadius), kernel.weight[kRadius].x, true);
    for (int i = 1 - kRadius; i <= kRadius; ++i) {
        sum = addToAverage(sum, sourceAt(column, y + i), kernel.weight[abs(i)].x, k, true);
    }
    return finishAverage(sum, k, true);
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy) - place.target.xy;
    ivec2 block = texel / kBlockTexels;
    if ((blocks[block.y * place.size.z + block.x] & kReached) == 0u) {
        blurred = encodeDepth(kFilter, litInput(place.source.z), momentRule());
        return;
    }
    ivec3 column = inScratch(ivec2(texel.x, 0), place.source.z);
    blurred = averagesLogs() ? blurLogarithms(column, texel.y) : blurValues(column, texel.y);
}
