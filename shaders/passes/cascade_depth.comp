#version 460
// SPDX-License-Identifier: Apache-2.0
// Finds the least and the greatest depth of the camera that a light's map has to serve.
#extension GL_GOOGLE_include_directive : require
#define PIXELS
#include "gnomon/lib/cascade_pixels.glsl"
layout(local_size_x = kBoundsGroup, local_size_y = kBoundsGroup) in;

shared uint found[kDepthKeys];

void main()
{
    if (gl_LocalInvocationIndex < kDepthKeys) {
        found[gl_LocalInvocationIndex] = 0u;
    }
    barrier();
    GpuCascadeLight light = cascade_lights[gl_WorkGroupID.z];
    uint least = 0u;
    uint greatest = 0u;
    for (int i = 0; i < kBoundsPixels * kBoundsPixels; ++i) {
        Seen seen = seenAt(light, pixelOf(i));
        if (seen.counts) {
            least = max(least, greatestKey(-seen.depth_m));
            greatest = max(greatest, greatestKey(seen.depth_m));
        }
    }
    if (greatest != 0u) {
        atomicMax(found[0], least);
        atomicMax(found[1], greatest);
    }
    barrier();
    if (gl_LocalInvocationIndex < kDepthKeys && found[gl_LocalInvocationIndex] != 0u) {
        atomicMax(cascade_keys[gl_WorkGroupID.z].key[gl_LocalInvocationIndex], found[gl_LocalInvocationIndex]);
    }
}
