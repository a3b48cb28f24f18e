#version 460
// SPDX-License-Identifier: Apache-2.0
// Turns drawn depths into what a filterable map stores.
// Based on: W. Donnelly, A. Lauritzen, "Variance Shadow Maps", 2006 (moments of multisampled depth are averaged, not its
// depths); A. Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007, chapter 8 (the second moment of a texel
// that a slope crosses: adding 1/4 (ddx^2 + ddy^2)).
// Departure: GPU Gems 3 takes the rasteriser's derivatives while drawing. We take them from the neighbouring texels
// afterwards, on each axis the smaller of the differences to both sides, so that silhouettes add nothing.
#extension GL_GOOGLE_include_directive : require
#ifdef SAMPLES // of a multisampled depth image
#define GN_SOURCE sampler2DMS
#else
#define GN_SOURCE sampler2D
#endif
#include "../lib/filter_pass.glsl"
#include "../lib/encoders.glsl"

// One group makes a block; a thread makes every eighth texel of a column.
layout(local_size_x = 32, local_size_y = 8) in;

float depthOf(ivec2 texel, int index)
{
#ifdef SAMPLES
    return momentDepth(texelFetch(source_image, place.source.xy + texel, index).x, kFlags, place.metric.x);
#else
    return momentDepth(texelFetch(source_image, place.source.xy + texel, 0).x, kFlags, place.metric.x);
#endif
}

// The smaller step from `depth` to the texels on both sides of it; those outside the tile do not count.
float smallerStep(float depth, ivec2 texel, ivec2 axis)
{
    ivec2 low = texel - axis;
    ivec2 high = texel + axis;
    float before = low.x < 0 || low.y < 0 ? 2.0 : abs(depth - depthOf(low, 0));
    float after = high.x >= place.size.x || high.y >= place.size.y ? 2.0 : abs(depthOf(high, 0) - depth);
    float step = min(before, after);
    return step < 2.0 ? step : 0.0;
}

// The same sample of each texel, so that steps are a texel long.
float slopeVariance(ivec2 texel, float depth)
{
    float x = smallerStep(depth, texel, ivec2(1, 0));
    float y = smallerStep(depth, texel, ivec2(0, 1));
    return 0.25 * (x * x + y * y);
}

bool isFinite(vec4 v)
{
    return all(notEqual(floatBitsToUint(v) & uvec4(0x7F800000u), uvec4(0x7F800000u)));
}

bool isOnRing(ivec2 texel)
{
    return texel.x == 0 || texel.y == 0 || texel.x == place.size.x - 1 || texel.y == place.size.y - 1;
}

vec4 averageOfSamples(EncodeInput e, vec4 depths)
{
    MomentRule rule = momentRule();
    e.depth = depths.x;
    vec4 first = encodeDepth(kFilter, e, rule);
#ifdef SAMPLES
    vec4 k = averageExponents(kFilter, rule);
    MomentSum sum = startAverage(first, 0.25, averagesLogs());
    for (int i = 1; i < 4; ++i) {
        e.depth = depths[i];
        sum = addToAverage(sum, encodeDepth(kFilter, e, rule), 0.25, k, averagesLogs());
    }
    return finishAverage(sum, k, averagesLogs());
#else
    return first;
#endif
}

void main()
{
    ivec2 block = ivec2(gl_WorkGroupID.xy);
    EncodeInput inputs[kMostImageLayers];
    vec4 lit[kMostImageLayers];
    for (int i = 0; i < place.target.w; ++i) {
        inputs[i] = litInput(i);
        lit[i] = encodeDepth(kFilter, inputs[i], momentRule());
    }
    bool any_caster = false;
    for (int row = int(gl_LocalInvocationID.y); row < kBlockTexels; row += int(gl_WorkGroupSize.y)) {
        ivec2 texel = block * kBlockTexels + ivec2(int(gl_LocalInvocationID.x), row);
        if (texel.x >= place.size.x || texel.y >= place.size.y) {
            break;
        }
        vec4 depths = vec4(depthOf(texel, 0));
#ifdef SAMPLES
        depths = vec4(depths.x, depthOf(texel, 1), depthOf(texel, 2), depthOf(texel, 3));
#endif
        bool caster = min(min(depths.x, depths.y), min(depths.z, depths.w)) < 1.0 && !isOnRing(texel);
        any_caster = any_caster || caster;
        float variance = caster && hasFlag(kFlags, kMomentDerivatives) ? slopeVariance(texel, depths.x) : 0.0;
        for (int i = 0; i < place.target.w; ++i) {
            vec4 value = lit[i];
            if (caster) {
                EncodeInput e = inputs[i];
                e.variance = variance;
                vec4 average = averageOfSamples(e, depths);
                value = isFinite(average) ? average : value;
            }
            imageStore(target_image, ivec3(place.target.xy + texel, place.target.z + i), value);
        }
    }
    if (any_caster) {
        atomicOr(blocks[block.y * place.size.z + block.x], kHasCaster);
    }
}
