#version 460
// SPDX-License-Identifier: Apache-2.0
// Puts what was found of cascades into the mask's views, one thread a view: those that say so in their slice.w were
// filled in for the base map.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/gpu_cascades.h"
#include "gnomon/shared/gpu_structs.h"
layout(local_size_x = kCompleteGroup) in;
layout(set = 0, binding = 0, std430) readonly buffer Fitted
{
    GpuFittedView fitted[];
};
layout(set = 0, binding = 1, std430) buffer Views
{
    GpuView views[];
};

// The row of a place X = half (x + w) + first w in the atlas, in texels, for (x - centre w) scale instead of x.
vec4 placedRow(vec4 row, vec4 w, float first, float size, float scale, float centre)
{
    float middle = first + 0.5 * size;
    // The part that is close to zero in the cascade's middle is scaled, then moved to the middle of the tile.
    return (row - w * (middle + 0.5 * size * centre)) * scale + w * middle;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(views.length())) {
        return;
    }
    uint number = uint(max(-views[i].slice.w, 0.0));
    if (number == 0u || number > uint(fitted.length())) {
        return;
    }
    GpuFittedView found = fitted[number - 1u];
    vec4 whole = views[i].whole;
    vec4 w = views[i].w;
    vec4 x = placedRow(views[i].x, w, whole.x, whole.z - whole.x, found.place.x, found.place.z);
    vec4 y = placedRow(views[i].y, w, whole.y, whole.w - whole.y, found.place.y, found.place.w);
    vec3 metric = views[i].metric.xyz;
    vec3 across = cross(x.xyz, y.xyz);
    views[i].x = x;
    views[i].y = y;
    views[i].scale.x = found.slice.w;
    views[i].plane_x = vec4(cross(metric, y.xyz), 0.0);
    views[i].plane_y = vec4(cross(x.xyz, metric), 0.0);
    views[i].plane_w = vec4(across, 1e-6 * length(across));
    views[i].slice = vec4(found.slice.xyz, 1.0);
}
