// SPDX-License-Identifier: Apache-2.0
// GLSL only: what the passes that make a map filterable are bound to. One layout for all of them; each uses what it needs.
#ifndef GNOMON_FILTER_PASS_GLSL
#define GNOMON_FILTER_PASS_GLSL
#include "../shared/filter_pass.h"
#include "../shared/gpu_structs.h"
#include "average.glsl"

// In the order of FilterConstants (vulkan/src/filter_layout.h).
layout(constant_id = 0) const int kFilter = 3; // a number of filter_numbers.h
layout(constant_id = 1) const int kFlags = 0; // MomentRule::flags
layout(constant_id = 2) const int kLayers = 2; // layers of lvsm
layout(constant_id = 3) const float kExponent = 1.0; // esm, evsm
layout(constant_id = 4) const float kExponentNegative = 1.0; // evsm
layout(constant_id = 5) const float kMomentBias = 0.0; // msm
layout(constant_id = 6) const int kRadius = 1; // of the blur, texels
layout(constant_id = 7) const int kChannels = 4; // of the map's format

layout(push_constant) uniform Place
{
    FilterPassPlace place;
};
#if defined(GN_FROM_DEPTHS) && defined(SAMPLES)
layout(set = 0, binding = 0) uniform sampler2DMS source_image;
#elif defined(GN_FROM_DEPTHS)
layout(set = 0, binding = 0) uniform sampler2D source_image;
#else
layout(set = 0, binding = 0) uniform sampler2DArray source_image;
#endif
#ifndef GN_FRAGMENT
layout(set = 0, binding = 1) uniform writeonly image2DArray target_image;
layout(set = 0, binding = 2, std430) buffer Blocks
{
    uint blocks[];
};
layout(set = 0, binding = 5, std430) buffer Counts
{
    BlurCounts counts;
};
#else
layout(set = 0, binding = 2, std430) readonly buffer Blocks
{
    uint blocks[];
};
#endif
layout(set = 0, binding = 3, std430) readonly buffer Layers
{
    GpuDepthLayers depth_layers[];
};
layout(set = 0, binding = 4) uniform Kernel
{
    BlurKernel kernel;
};

// Flags of a block.
const uint kReachedAlongX = 1u; // a blur along x reads a caster for it
const uint kReached = 2u;       // a blur along x and y reads one

MomentRule momentRule()
{
    MomentRule rule; // members for reading stay unset: these passes write
    rule.flags = kFlags;
    rule.sampling = 0;
    rule.layers = kLayers;
    rule.exponent = kExponent;
    rule.exponent_negative = kExponentNegative;
    rule.moment_bias = kMomentBias;
    rule.min_variance = 0.0;
    rule.min_variance_texels = 0.0;
    rule.rounding = 0.0;
    rule.rounding_negative = 0.0;
    rule.linstep = 0.0;
    rule.power = 1.0;
    rule.lighten = 0.0;
    rule.lighten_cut = 0.0;
    rule.anisotropy = 1.0;
    return rule;
}
bool averagesLogs()
{
    return averagesLogarithms(kFilter, kFlags);
}

// The channels that the image has, of a value read from it: the others need no arithmetic.
vec4 storedPart(vec4 v)
{
    return vec4(v.x, kChannels > 1 ? v.y : 0.0, kChannels > 2 ? v.zw : vec2(0.0));
}

// The input of a texel without a caster: the far plane.
EncodeInput litInput(int image_layer)
{
    EncodeInput e;
    e.depth = momentDepth(1.0, kFlags, place.metric.x);
    e.variance = 0.0;
    e.first = depth_layers[place.source.w].layer[min(2 * image_layer, kDepthLayers - 1)];
    e.second = depth_layers[place.source.w].layer[min(2 * image_layer + 1, kDepthLayers - 1)];
    return e;
}

#endif
