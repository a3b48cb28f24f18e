#version 460
// SPDX-License-Identifier: Apache-2.0
// Counts how deep what was drawn lies. Whole numbers throughout, so the order in which threads come
// does not matter.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#ifdef SAMPLES
#define SOURCE texture2DMS
#else
#define SOURCE texture2D
#endif
#include "gnomon/shared/depth_layers.h"
#include "gnomon/shared/layer_placing.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0) uniform SOURCE depths;
layout(set = 0, binding = 1, std430) buffer Histogram
{
    uint histogram[kDepthBins];
};
layout(push_constant, std430) uniform Push
{
    GpuHistogramPush push;
};

shared uint counts[kDepthBins];

void main()
{
    const int threads = int(gl_WorkGroupSize.x * gl_WorkGroupSize.y);
    for (int i = int(gl_LocalInvocationIndex); i < kDepthBins; i += threads) {
        counts[i] = 0u;
    }
    barrier();
    // A group takes four times as many texels as it has threads: fewer groups, fewer sums at the end.
    ivec2 first = ivec2(gl_WorkGroupID.xy) * ivec2(gl_WorkGroupSize.xy) * 2 + ivec2(gl_LocalInvocationID.xy);
    for (int i = 0; i < 4; ++i) {
        ivec2 sampled = first + ivec2(gl_WorkGroupSize.xy) * ivec2(i & 1, i >> 1);
        ivec2 texel = sampled * push.more.x + push.more.x / 2;
        if (texel.x < push.tile.z && texel.y < push.tile.w) {
            float metric = texelFetch(depths, push.tile.xy + texel, 0).x;
            if (metric < 1.0) { // else nothing was drawn there
                atomicAdd(counts[binOf(momentDepth(metric, push.more.y, push.metric.x), kDepthBins)], 1u);
            }
        }
    }
    barrier();
    for (int i = int(gl_LocalInvocationIndex); i < kDepthBins; i += threads) {
        if (counts[i] != 0u) {
            atomicAdd(histogram[i], counts[i]);
        }
    }
}
