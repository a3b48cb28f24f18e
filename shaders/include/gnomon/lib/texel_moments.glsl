// SPDX-License-Identifier: Apache-2.0
// GLSL only: what a texel of a filterable map stores before it is blurred, from the depths that were drawn. A pass that
// includes it defines GN_FROM_DEPTHS first.
// Based on: W. Donnelly, A. Lauritzen, "Variance Shadow Maps", 2006 (moments of multisampled depth are averaged, not its
// depths); A. Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007, chapter 8 (the second moment of a texel
// that a slope crosses: adding 1/4 (ddx^2 + ddy^2)).
// Departure: GPU Gems 3 takes the rasteriser's derivatives while drawing. We take them from the neighbouring texels
// afterwards, on each axis the smaller of the differences to both sides, so that silhouettes add nothing.
#ifndef GNOMON_TEXEL_MOMENTS_GLSL
#define GNOMON_TEXEL_MOMENTS_GLSL
#include "encoders.glsl"
#include "filter_pass.glsl"

// Copies of push constants [drivers: uniforms].
ivec2 first_of_tile = place.source.xy;
ivec2 last_in_tile = place.size.xy - 1;
float near_over_far = place.metric.x;

float depthOf(ivec2 texel, int index)
{
#ifdef SAMPLES
    return momentDepth(texelFetch(source_image, first_of_tile + texel, index).x, kFlags, near_over_far);
#else
    return momentDepth(texelFetch(source_image, first_of_tile + texel, 0).x, kFlags, near_over_far);
#endif
}

// The smaller step from `depth` to the texels on both sides of it; those outside the tile do not count.
float smallerStep(float depth, ivec2 texel, ivec2 axis)
{
    ivec2 low = texel - axis;
    ivec2 high = texel + axis;
    float before = low.x < 0 || low.y < 0 ? 2.0 : abs(depth - depthOf(low, 0));
    float after = high.x > last_in_tile.x || high.y > last_in_tile.y ? 2.0 : abs(depthOf(high, 0) - depth);
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

struct TexelMoments {
    vec4 value;
    bool has_caster;
};

// The tile's outermost texels hold what is lit, and so does everything outside. `lit` is `far_plane` encoded.
TexelMoments momentsOf(ivec2 texel, EncodeInput far_plane, vec4 lit)
{
    bool inside = all(greaterThan(texel, ivec2(0))) && all(lessThan(texel, last_in_tile));
    ivec2 at = clamp(texel, ivec2(0), last_in_tile);
    vec4 depths = vec4(depthOf(at, 0));
#ifdef SAMPLES
    depths = vec4(depths.x, depthOf(at, 1), depthOf(at, 2), depthOf(at, 3));
#endif
    EncodeInput e = far_plane;
    e.variance = hasFlag(kFlags, kMomentDerivatives) ? slopeVariance(at, depths.x) : 0.0;
    vec4 average = averageOfSamples(e, depths);
    TexelMoments moments;
    moments.has_caster = inside && min(min(depths.x, depths.y), min(depths.z, depths.w)) < 1.0;
    moments.value = moments.has_caster && isFinite(average) ? average : lit;
    return moments;
}

#endif
