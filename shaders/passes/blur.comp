#version 460
// SPDX-License-Identifier: Apache-2.0
// One direction of a separable blur. A thread makes eight texels in a row of the direction and reads each texel that
// they need once: weights slide past it in registers.
// The tile's outermost texels hold what is lit, and so does everything outside: reads are clamped.
#extension GL_GOOGLE_include_directive : require
#include "../lib/filter_pass.glsl"

layout(local_size_x = 32, local_size_y = 4) in; // across the direction, along it: kBlockTexels both ways

vec4 sourceAt(ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), place.size.xy - 1);
    return texelFetch(source_image, ivec3(place.source.xy + inside, place.source.z + int(gl_WorkGroupID.z)), 0);
}

void store(ivec2 texel, vec4 value)
{
    if (texel.x < place.size.x && texel.y < place.size.y) {
        imageStore(target_image, ivec3(place.target.xy + texel, place.target.z + int(gl_WorkGroupID.z)), value);
    }
}

void copy(ivec2 first, ivec2 axis)
{
    for (int i = 0; i < kBlurOutputs; ++i) {
        store(first + i * axis, sourceAt(first + i * axis));
    }
}

void blurValues(ivec2 first, ivec2 axis)
{
    vec4 total[kBlurOutputs];
    float weight[kBlurOutputs]; // of the texel that was just read, for each output
    for (int o = 0; o < kBlurOutputs; ++o) {
        total[o] = vec4(0.0);
        weight[o] = 0.0;
    }
    for (int i = -kRadius; i < kBlurOutputs + kRadius; ++i) {
        for (int o = kBlurOutputs - 1; o > 0; --o) {
            weight[o] = weight[o - 1];
        }
        weight[0] = kernel.weight[abs(i)].x;
        vec4 value = sourceAt(first + i * axis);
        for (int o = 0; o < kBlurOutputs; ++o) {
            total[o] += value * weight[o];
        }
    }
    for (int o = 0; o < kBlurOutputs; ++o) {
        store(first + o * axis, total[o]);
    }
}

void blurLogarithms(ivec2 first, ivec2 axis)
{
    vec4 k = averageExponents(kFilter, momentRule());
    for (int o = 0; o < kBlurOutputs; ++o) {
        MomentSum sum = startAverage(sourceAt(first + (o - kRadius) * axis), kernel.weight[kRadius].x, true);
        for (int i = 1 - kRadius; i <= kRadius; ++i) {
            sum = addToAverage(sum, sourceAt(first + (o + i) * axis), kernel.weight[abs(i)].x, k, true);
        }
        store(first + o * axis, finishAverage(sum, k, true));
    }
}

void main()
{
    ivec2 block = ivec2(gl_WorkGroupID.xy);
    uint work = blocks[block.y * place.size.z + block.x];
    ivec2 axis = ivec2(1 - kAxis, kAxis); // choosing one of two vectors by a constant is wrong in Mesa 22.3
    ivec2 across = ivec2(1) - axis;
    ivec2 first = block * kBlockTexels + across * int(gl_LocalInvocationID.x) +
                  axis * kBlurOutputs * int(gl_LocalInvocationID.y);
    if ((work & (kAxis == 0 ? kBlurX : kBlurY)) != 0u) {
        if (averagesLogs()) {
            blurLogarithms(first, axis);
        } else {
            blurValues(first, axis);
        }
    } else if (kAxis == 0 && (work & kFillX) != 0u) {
        copy(first, axis);
    }
}
