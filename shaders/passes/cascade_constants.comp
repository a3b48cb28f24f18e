#version 460
// SPDX-License-Identifier: Apache-2.0
// Puts what was found of cascades into the mask's constants, one thread a view: those that say so in their slice.w were
// filled in for the base map.
#extension GL_GOOGLE_include_directive : require
#include "../shared/gpu_cascades.h"
#include "../shared/gpu_structs.h"
layout(local_size_x = kViewsPerLayer) in;
layout(set = 0, binding = 0, std430) readonly buffer Views
{
    GpuFittedView fitted[];
};
layout(set = 0, binding = 1, std430) buffer Constants
{
    vec4 words[];
};
layout(push_constant, std430) uniform Push
{
    uint first; // word of the layer's first view
};

const uint kWords = 12; // of a GpuView, in its order
const uint kX = 0, kY = 1, kW = 2, kMetric = 3, kScale = 5, kPlaneX = 6, kPlaneY = 7, kPlaneW = 8, kWhole = 9;
const uint kSlice = 11;

// The row of a place X = half (x + w) + first w in the atlas, in texels, for (x - centre w) scale instead of x.
vec4 placedRow(vec4 row, vec4 w, float first, float size, float scale, float centre)
{
    float middle = first + 0.5 * size;
    // What is close to zero in the cascade's middle is scaled; then it is moved to the middle of the tile.
    return (row - w * (middle + 0.5 * size * centre)) * scale + w * middle;
}

void main()
{
    uint at = first + kWords * gl_LocalInvocationID.x;
    uint view = uint(words[at + kSlice].w);
    if (view == 0u || view > uint(fitted.length())) { // what was never filled in may hold anything
        return;
    }
    GpuFittedView found = fitted[view - 1u];
    vec4 whole = words[at + kWhole];
    vec4 w = words[at + kW];
    vec4 x = placedRow(words[at + kX], w, whole.x, whole.z - whole.x, found.place.x, found.place.z);
    vec4 y = placedRow(words[at + kY], w, whole.y, whole.w - whole.y, found.place.y, found.place.w);
    vec3 metric = words[at + kMetric].xyz;
    vec3 across = cross(x.xyz, y.xyz);
    words[at + kX] = x;
    words[at + kY] = y;
    words[at + kScale].x = found.slice.w;
    words[at + kPlaneX] = vec4(cross(metric, y.xyz), 0.0);
    words[at + kPlaneY] = vec4(cross(x.xyz, metric), 0.0);
    words[at + kPlaneW] = vec4(across, 1e-6 * length(across));
    words[at + kSlice] = vec4(found.slice.xyz, 0.0);
}
