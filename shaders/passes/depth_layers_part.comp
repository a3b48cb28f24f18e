#version 460
// SPDX-License-Identifier: Apache-2.0
// Parts a view's layers where the least light is expected to bleed: gnomon/shared/layer_gaps.h. One group for a view.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/gpu_structs.h"
#include "gnomon/shared/layer_gaps.h"
#include "gnomon/shared/layer_placing.h"

layout(local_size_x = kGapBins) in;
layout(set = 0, binding = 1, std430) buffer Lost
{
    uint lost[kGapBins * kGapColumns];
};
layout(set = 0, binding = 2, std430) buffer Layers
{
    GpuDepthLayers layers_of[];
};
layout(push_constant, std430) uniform Push
{
    GpuPlacePush push;
};

shared float gains[kGapBins];            // loss that a split there saves
shared int splits[kDepthLayers + 1];     // the bins where layers begin, and kGapBins
shared float begins_of[kDepthLayers + 1]; // the same as depths
shared float uniform_loss;               // loss of layers of one width
shared bool is_uniform;                  // are those taken?

// From single losses to sums: up the rows, as a near end leaves all that a later one leaves; then along them.
void sumUp(int thread)
{
    uint sum = 0u;
    for (int row = kGapBins - 1; row >= 0; --row) {
        int at = row * kGapColumns + thread + 1;
        sum += lost[at];
        lost[at] = sum;
    }
    memoryBarrierBuffer();
    barrier();
    sum = 0u;
    for (int column = 1; column < kGapColumns; ++column) {
        int at = thread * kGapColumns + column;
        sum += lost[at];
        lost[at] = sum;
    }
    memoryBarrierBuffer();
    barrier();
}

float lossOf(int begins, int ends)
{
    int row = nearBin(begins, ends, push.how.x) * kGapColumns;
    return layerLoss(float(lost[row + ends] - lost[row + begins]), float(lost[kGapBins]), ends - begins);
}

float wholeLoss(int count)
{
    float loss = 0.0;
    for (int i = 0; i < count; ++i) {
        loss += lossOf(splits[i], splits[i + 1]);
    }
    return loss;
}

// The layer that holds a bin.
int layerAt(int bin)
{
    int layer = 0;
    while (splits[layer + 1] <= bin) {
        ++layer;
    }
    return layer;
}

// Less than 0 where no split may be.
float gainAt(int bin)
{
    int layer = layerAt(bin);
    int begins = splits[layer];
    int ends = splits[layer + 1];
    return bin < begins + kLeastBins || bin > ends - kLeastBins
               ? -1.0
               : max(lossOf(begins, ends) - lossOf(begins, bin) - lossOf(bin, ends), 0.0);
}

void addSplit(int parts)
{
    int best = 0;
    for (int i = 1; i < kGapBins; ++i) {
        best = gains[i] > gains[best] ? i : best;
    }
    int layer = layerAt(best);
    float whole = lossOf(splits[layer], splits[layer + 1]);
    float least = whole - gains[best];
    float all = float(lost[kGapBins]);
    int low = best;
    while (gains[low - 1] >= 0.0 && isLossAlike(whole - gains[low - 1], least, all)) {
        --low;
    }
    int high = best;
    while (gains[high + 1] >= 0.0 && isLossAlike(whole - gains[high + 1], least, all)) {
        ++high;
    }
    for (int i = parts; i > layer; --i) {
        splits[i + 1] = splits[i];
    }
    splits[layer + 1] = (low + high) / 2;
}

void partLayers(int thread, int count)
{
    if (thread == 0) {
        splits[0] = 0;
        splits[1] = kGapBins;
    }
    barrier();
    for (int parts = 1; parts < count; ++parts) {
        gains[thread] = gainAt(thread);
        barrier();
        if (thread == 0) {
            addSplit(parts);
        }
        barrier();
    }
}

// Where the last frame's layer begins in this frame's metric.
float carried(int layer)
{
    float begins = layers_of[push.slot.x].layer[layer].w;
    float ratio = push.carry.z;
    float linear = hasFlag(push.slot.w, kMomentZOverW) ? begins * ratio / (1.0 - begins * (1.0 - ratio)) : begins;
    return momentDepth(linear * push.carry.x + push.carry.y, push.slot.w, push.carry.w);
}

// Layers of one width, unless the splits save enough of what they lose.
void chooseLayers(int count)
{
    uniform_loss = 0.0;
    for (int i = 0; i < count; ++i) {
        uniform_loss += lossOf(uniformBin(i, count), uniformBin(i + 1, count));
    }
    is_uniform = !savesEnough(wholeLoss(count), uniform_loss, count, kConvincingShare);
    for (int i = 0; i <= count; ++i) {
        begins_of[i] = is_uniform ? uniformBegin(i, count) : float(splits[i]) / float(kGapBins);
    }
}

// Layers that were there stay where they are while they lose next to nothing by it, and save enough; else they go a
// share of the way.
void moveFromLast(int count)
{
    float all = float(lost[kGapBins]);
    float least = is_uniform ? uniform_loss : wholeLoss(count);
    bool stay = true;
    for (int i = 1; i < count; ++i) {
        float last = carried(i);
        begins_of[i] = last + push.how.y * (begins_of[i] - last);
        splits[i] = int(last * float(kGapBins) + 0.5);
        stay = stay && splits[i] - splits[i - 1] >= kLeastBins;
    }
    float held = wholeLoss(count);
    stay = stay && splits[count] - splits[count - 1] >= kLeastBins && isLossAlike(held, least, all) &&
           savesEnough(held, uniform_loss, count, kHeldGapsShare);
    for (int i = 1; stay && i < count; ++i) {
        begins_of[i] = carried(i);
    }
}

void main()
{
    int thread = int(gl_LocalInvocationIndex);
    int count = push.slot.y;
    sumUp(thread);
    partLayers(thread, count);
    if (thread == 0) {
        chooseLayers(count);
        if (push.how.z == 0.0) {
            moveFromLast(count);
        }
    }
    barrier();
    if (thread < kDepthLayers) {
        vec4 layer = noLayer();
        if (thread < count) {
            layer = layerBetween(begins_of[thread], begins_of[thread + 1], begins_of[thread], push.how.x);
        }
        layers_of[push.slot.x].layer[thread] = layer;
    }
}
