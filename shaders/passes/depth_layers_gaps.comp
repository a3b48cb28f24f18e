#version 460
// SPDX-License-Identifier: Apache-2.0
// Sums up what light would bleed between pairs of casters, by the near end of a receiver's layer and the receiver's
// depth: gnomon/shared/layer_gaps.h. Whole numbers throughout, so the order in which threads come does not matter.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#ifdef SAMPLES
#define SOURCE texture2DMS
#else
#define SOURCE texture2D
#endif
#include "gnomon/shared/layer_gaps.h"
#include "gnomon/shared/layer_placing.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0) uniform SOURCE depths;
// Row: the last bin of near ends that leave it. Column: the receiver's bin, from 1 on.
layout(set = 0, binding = 1, std430) buffer Lost
{
    uint lost[kGapBins * kGapColumns];
};
layout(push_constant, std430) uniform Push
{
    GpuHistogramPush push;
};

const int kBehind = 8; // receivers that are looked for around a pair

// Less than 0 where nothing was drawn.
float depthAt(ivec2 texel)
{
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, push.tile.zw))) {
        return -1.0;
    }
    float metric = texelFetch(depths, push.tile.xy + texel, 0).x;
    return metric < 1.0 ? momentDepth(metric, push.more.y, push.metric.x) : -1.0;
}

// On a spiral of golden angles, from 1/64 to 1/8 of the tile's side away.
ivec2 awayFrom(ivec2 texel, int i)
{
    float angle = 2.3999632 * float(i);
    float reach = float(max(push.tile.z, push.tile.w)) * exp2(3.0 * float(i) / float(kBehind - 1)) / 64.0;
    return texel + ivec2(reach * vec2(cos(angle), sin(angle)));
}

void countPair(ivec2 texel, float own, float other)
{
    float a = min(own, other);
    float b = max(own, other);
    if (a < 0.0 || binOf(a, kGapBins) == binOf(b, kGapBins)) {
        return; // nothing there, or nothing to part
    }
    for (int i = 0; i < kBehind; ++i) {
        float c = depthAt(awayFrom(texel, i));
        int weight = gapWeight(a, b, c);
        if (weight > 0) {
            // The share that a near end between the two leaves falls from all to nothing.
            int last = binOf(mix(a, b, (float(i) + 0.5) / float(kBehind)), kGapBins);
            atomicAdd(lost[last * kGapColumns + binOf(c, kGapBins) + 1], uint(weight));
        }
    }
}

void main()
{
    ivec2 first = ivec2(gl_WorkGroupID.xy) * ivec2(gl_WorkGroupSize.xy) * 2 + ivec2(gl_LocalInvocationID.xy);
    for (int i = 0; i < 4; ++i) {
        ivec2 sampled = first + ivec2(gl_WorkGroupSize.xy) * ivec2(i & 1, i >> 1);
        ivec2 texel = sampled * push.more.x + push.more.x / 2;
        float own = depthAt(texel);
        if (own >= 0.0) {
            countPair(texel, own, depthAt(texel + ivec2(push.more.z, 0)));
            countPair(texel, own, depthAt(texel + ivec2(0, push.more.z)));
        }
    }
}
