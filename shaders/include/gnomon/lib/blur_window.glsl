// SPDX-License-Identifier: Apache-2.0
// GLSL only: one direction of a separable blur by a thread that walks along it. It reads each texel on its way once and
// adds it to the sums of all texels within the radius, which are in registers.
#ifndef GNOMON_BLUR_WINDOW_GLSL
#define GNOMON_BLUR_WINDOW_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "filter_pass.glsl"

// MomentSum [i] is that of the texel i - kRadius texels after the one that is taken in next.
vec4 window_total[2 * kRadius];
vec4 window_reference[2 * kRadius];
float window_weight[kRadius + 1]; // by distance
vec4 window_exponents;            // averageExponents()

void startWindow()
{
    [[unroll]] for (int i = 0; i < 2 * kRadius; ++i) {
        window_total[i] = vec4(0.0);
        window_reference[i] = vec4(0.0);
    }
    [[unroll]] for (int i = 0; i <= kRadius; ++i) {
        window_weight[i] = kernel.weight[i].x;
    }
    window_exponents = averageExponents(kFilter, momentRule());
}

MomentSum sumInWindow(int i, vec4 value)
{
    MomentSum sum = MomentSum(window_total[i], window_reference[i]);
    return addToAverage(sum, value, window_weight[abs(i - kRadius)], window_exponents, averagesLogs());
}

// Takes the next texel in. Returns the blurred texel kRadius before it, which that completes.
vec4 slideWindow(vec4 value)
{
    MomentSum complete = sumInWindow(0, value);
    [[unroll]] for (int i = 1; i < 2 * kRadius; ++i) {
        MomentSum sum = sumInWindow(i, value);
        window_total[i - 1] = sum.total;
        window_reference[i - 1] = sum.reference;
    }
    MomentSum begun = startAverage(value, window_weight[kRadius], averagesLogs());
    window_total[2 * kRadius - 1] = begun.total;
    window_reference[2 * kRadius - 1] = begun.reference;
    return finishAverage(complete, window_exponents, averagesLogs());
}

#endif
