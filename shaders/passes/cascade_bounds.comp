#version 460
// SPDX-License-Identifier: Apache-2.0
// Finds, for each cascade, the rectangle of the base map that its pixels lie in, without and with room for rays to the
// rest of the light.
#extension GL_GOOGLE_include_directive : require
#define PIXELS
#include "gnomon/lib/cascade_pixels.glsl"
layout(local_size_x = kBoundsGroup, local_size_y = kBoundsGroup) in;

shared uint found[kBoundKeys * kMostCascades];
shared vec2 slices[kMostCascades]; // begin, end

// Bounds of a thread's pixels in a cascade: minus x, minus y, x, y, each the greatest; and with room around.
struct Bounds {
    vec4 ends;
    vec4 roomy;
};
const float kNothing = -3.4e38;

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
    // Their number is a constant, so that they are registers.
    Bounds bounds[kMostCascades];
    vec2 slice[kMostCascades];
    for (int c = 0; c < kMostCascades; ++c) {
        bounds[c] = Bounds(vec4(kNothing), vec4(kNothing));
        slice[c] = slices[c];
    }
    for (int i = 0; i < kBoundsPixels * kBoundsPixels; ++i) {
        Seen seen = seenAt(light, pixelOf(i));
        vec4 place = vec4(-seen.place, seen.place);
        for (int c = 0; c < kMostCascades; ++c) {
            bool holds = seen.counts && c < count && sliceCounts(seen.depth_m, slice[c].x, slice[c].y);
            bounds[c].ends = holds ? max(bounds[c].ends, place) : bounds[c].ends;
            bounds[c].roomy = holds ? max(bounds[c].roomy, place + seen.room.xyxy) : bounds[c].roomy;
        }
    }
    for (int c = 0; c < kMostCascades; ++c) {
        if (bounds[c].ends.x > kNothing) {
            for (int i = 0; i < 4; ++i) {
                atomicMax(found[kBoundKeys * c + i], greatestKey(bounds[c].ends[i]));
                atomicMax(found[kBoundKeys * c + 4 + i], greatestKey(bounds[c].roomy[i]));
            }
        }
    }
    barrier();
    if (thread < kBoundKeys * count && found[thread] != 0u) {
        atomicMax(cascade_keys[gl_WorkGroupID.z].key[kDepthKeys + thread], found[thread]);
    }
}
