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

// Lets cascade c's bounds hold what this thread sees of it. Atomics are done once for all of its pixels: software does
// them one by one.
void note(int c, Seen seen[4])
{
    const float nothing = -3.4e38;
    vec4 ends = vec4(nothing);
    vec4 roomy = vec4(nothing);
    bool any_counts = false;
    for (int i = 0; i < 4; ++i) {
        if (seen[i].counts && sliceCounts(seen[i].depth_m, slices[c].x, slices[c].y)) {
            vec4 place = vec4(-seen[i].place, seen[i].place);
            ends = max(ends, place);
            roomy = max(roomy, place + seen[i].room.xyxy);
            any_counts = true;
        }
    }
    if (any_counts) {
        for (int i = 0; i < 4; ++i) {
            atomicMax(found[kBoundKeys * c + i], greatestKey(ends[i]));
            atomicMax(found[kBoundKeys * c + 4 + i], greatestKey(roomy[i]));
        }
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
    Seen seen[4];
    for (int i = 0; i < 4; ++i) {
        seen[i] = seenAt(light, pixelOf(i));
    }
    for (int c = 0; c < count; ++c) {
        note(c, seen);
    }
    barrier();
    if (thread < kBoundKeys * count && found[thread] != 0u) {
        atomicMax(cascade_keys[gl_WorkGroupID.z].key[kDepthKeys + thread], found[thread]);
    }
}
