#version 460
// SPDX-License-Identifier: Apache-2.0
// Finds, for each cascade, the rectangle of the base map that its pixels lie in.
#extension GL_GOOGLE_include_directive : require
#define PIXELS
#include "../lib/cascade_pixels.glsl"
layout(local_size_x = kBoundsGroup, local_size_y = kBoundsGroup) in;

shared uint found[4 * kMostCascades];
shared vec2 slices[kMostCascades]; // begin, end

void main()
{
    GpuCascadeLight light = cascade_lights[gl_WorkGroupID.z];
    int count = int(light.cascades.x);
    int thread = int(gl_LocalInvocationIndex);
    if (thread < 4 * kMostCascades) {
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
                    atomicMax(found[4 * c], greatestKey(seen.room.x - seen.place.x));
                    atomicMax(found[4 * c + 1], greatestKey(seen.room.y - seen.place.y));
                    atomicMax(found[4 * c + 2], greatestKey(seen.place.x + seen.room.x));
                    atomicMax(found[4 * c + 3], greatestKey(seen.place.y + seen.room.y));
                }
            }
        }
    }
    barrier();
    if (thread < 4 * count && found[thread] != 0u) {
        atomicMax(cascade_keys[gl_WorkGroupID.z].key[kDepthKeys + thread], found[thread]);
    }
}
