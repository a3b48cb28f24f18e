#version 460
// SPDX-License-Identifier: Apache-2.0
// Finds, for each cascade, the rectangle of the base map that its pixels lie in, without and with room for rays to the
// rest of the light.
#extension GL_GOOGLE_include_directive : require
#define PIXELS
#include "../lib/cascade_pixels.glsl"
layout(local_size_x = kBoundsGroup, local_size_y = kBoundsGroup) in;

shared uint found[kBoundKeys * kMostCascades];
shared vec2 slices[kMostCascades]; // begin, end

// Lets a cascade's bounds from `first` on hold a place, without and with its room.
void note(int first, Seen seen)
{
    vec4 ends = vec4(-seen.place, seen.place);
    for (int i = 0; i < kBoundKeys; ++i) {
        int end = i & 3;
        float room = i < 4 ? 0.0 : seen.room[end & 1];
        atomicMax(found[first + i], greatestKey(ends[end] + room));
    }
}

void main()
{
    GpuCascadeLight light = cascade_lights[gl_WorkGroupID.z];
    int count = int(light.cascades.x);
    int thread = int(gl_LocalInvocationIndex);
    if (thread < kBoundKeys * kMostCascades) {
        found[thread] = 0u;
    }
    if (thread < count) {
        slices[thread] = cascadeSlice(light, thread).xy;
    }
    barrier();
    for (int i = 0; i < 4; ++i) {
        Seen seen = seenAt(light, pixelOf(i));
        if (seen.counts) {
            for (int c = 0; c < count; ++c) {
                if (sliceCounts(seen.depth_m, slices[c].x, slices[c].y)) {
                    note(kBoundKeys * c, seen);
                }
            }
        }
    }
    barrier();
    if (thread < kBoundKeys * count && found[thread] != 0u) {
        atomicMax(cascade_keys[gl_WorkGroupID.z].key[kDepthKeys + thread], found[thread]);
    }
}
