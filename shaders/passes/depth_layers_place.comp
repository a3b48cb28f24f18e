#version 460
// SPDX-License-Identifier: Apache-2.0
// Based on: S. Lloyd, "Least Squares Quantization in PCM", 1982, as A. Lauritzen, M. McCool, "Layered Variance Shadow
// Maps", 2008, place layers with it. One group for a view: sums over bins are differences of running sums, so that a
// step costs the same however much was drawn; they are whole numbers, and so exact.
// Departure: layers that were there before move only a share of the way, or are held until they are off, and the sum
// over depths is one over bins.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/gpu_structs.h"
#include "gnomon/shared/depth_layers.h"
#include "gnomon/shared/layer_placing.h"

const int kThreads = 256;
const int kBinsEach = kDepthBins / kThreads;

layout(local_size_x = kThreads) in;
layout(set = 0, binding = 1, std430) readonly buffer Histogram
{
    uint histogram[kDepthBins];
};
layout(set = 0, binding = 2, std430) buffer Layers
{
    GpuDepthLayers layers_of[];
};
layout(push_constant, std430) uniform Push
{
    GpuPlacePush push;
};

shared uvec2 before[kDepthBins + 1]; // sums over all bins before this one: x: depths, y: times the number of their bin
shared uvec2 sums[kThreads];
const int kHeld = 2; // index into `means`: where they were
shared float means[3][kDepthLayers];
shared uint moved;

// At most kMostSamplesAlong^2 = 2^18 depths, times a bin's number below 2^10.
void sumUp(int thread)
{
    uvec2 own = uvec2(0u);
    for (int i = 0; i < kBinsEach; ++i) {
        uint bin = uint(thread * kBinsEach + i);
        own += uvec2(histogram[bin], histogram[bin] * bin);
    }
    sums[thread] = own;
    barrier();
    for (int reach = 1; reach < kThreads; reach *= 2) {
        uvec2 other = thread >= reach ? sums[thread - reach] : uvec2(0u);
        barrier();
        sums[thread] += other;
        barrier();
    }
    uvec2 running = sums[thread] - own;
    for (int i = 0; i < kBinsEach; ++i) {
        uint bin = uint(thread * kBinsEach + i);
        before[bin] = running;
        running += uvec2(histogram[bin], histogram[bin] * bin);
    }
    if (thread == kThreads - 1) {
        before[kDepthBins] = running;
    }
    barrier();
}

// The first bin whose centre is not before `depth`: layerHoldsBin().
int firstBinFrom(float depth)
{
    return clamp(int(ceil(depth * float(kDepthBins) - 0.5)), 0, kDepthBins);
}

// The first bin that has all of the first `depths` depths before it or in it: by bisection.
int binOfRank(uint depths)
{
    int low = 0;
    int high = kDepthBins - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (before[middle + 1].x >= depths) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

float startOf(int layer, int count)
{
    if (push.how.z == 0.0) {
        // Where the last frame's mean lies in this frame's metric.
        float mean = layers_of[push.slot.x].layer[layer].w;
        float ratio = push.carry.z;
        float linear = hasFlag(push.slot.w, kMomentZOverW) ? mean * ratio / (1.0 - mean * (1.0 - ratio)) : mean;
        return momentDepth(linear * push.carry.x + push.carry.y, push.slot.w, push.carry.w);
    }
    uint all = before[kDepthBins].x;
    float lowest = all > 0u ? binCentre(binOfRank(1u), kDepthBins) : 0.0;
    float highest = all > 0u ? binCentre(binOfRank(all), kDepthBins) : 1.0;
    return lloydStart(layer, count, lowest, highest);
}

// Where layer `wanted` begins, for these means; 1 for the one after the last.
float beginOf(int wanted, int count, int turn)
{
    float begins = 0.0;
    for (int i = 1; i <= wanted && i < count; ++i) {
        begins = lloydSplit(i, count, means[turn][i - 1], means[turn][i], begins);
    }
    return wanted < count ? begins : 1.0;
}

float nextMean(int layer, int count, int turn)
{
    float mean = means[turn][layer];
    // The last bin's centre is before 1.
    uvec2 held = before[firstBinFrom(beginOf(layer + 1, count, turn))] - before[firstBinFrom(beginOf(layer, count, turn))];
    float sum = (float(held.y) + 0.5 * float(held.x)) / float(kDepthBins);
    float target = lloydMean(float(held.x), sum, mean);
    return target == mean ? mean : mean + push.how.y * (target - mean);
}

// The row of means to use: where the layers were, or if that is off, where they rest.
int heldMeans(int thread, int count, int rest)
{
    if (thread == 0) {
        moved = 0u;
    }
    barrier();
    if (thread > 0 && thread < count &&
        isSplitOff(beginOf(thread, count, kHeld), beginOf(thread, count, rest), means[kHeld][thread - 1],
                   means[kHeld][thread])) {
        atomicOr(moved, 1u);
    }
    barrier();
    return moved == 0u ? kHeld : rest;
}

void main()
{
    int thread = int(gl_LocalInvocationIndex);
    int count = push.slot.y;
    sumUp(thread);
    if (thread < count) {
        means[0][thread] = startOf(thread, count);
        means[kHeld][thread] = means[0][thread];
    }
    int turn = 0;
    for (int step = 0; step < push.slot.z; ++step) {
        if (thread == 0) {
            moved = 0u;
        }
        barrier();
        if (thread < count) {
            float next = nextMean(thread, count, turn);
            means[1 - turn][thread] = next;
            if (next != means[turn][thread]) {
                atomicOr(moved, 1u);
            }
        }
        barrier();
        turn = 1 - turn;
        uint any = moved;
        barrier();
        if (any == 0u) {
            break;
        }
    }
    if (push.how.w > 0.0) {
        turn = heldMeans(thread, count, turn);
    }
    if (thread < kDepthLayers) {
        vec4 layer = noLayer();
        if (thread < count) {
            layer = layerBetween(beginOf(thread, count, turn), beginOf(thread + 1, count, turn), means[turn][thread],
                                 push.how.x);
        }
        layers_of[push.slot.x].layer[thread] = layer;
    }
}
