#version 460
// SPDX-License-Identifier: Apache-2.0
// From what was found of a light's cascades to how each lies on the base map. One thread a cascade.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/cascade_pixels.glsl"
layout(local_size_x = kMostCascades) in;
layout(set = 0, binding = 2, std430) writeonly buffer Views
{
    GpuFittedView views[]; // by their place in the plan
};
layout(set = 0, binding = 3, std430) writeonly buffer Report
{
    GpuFittedView report[]; // the same, for whoever asks once the GPU has finished
};

// Low x, y, high x, y, from the key `first` on.
vec4 boundsFrom(int first)
{
    uint light = gl_WorkGroupID.z;
    return vec4(-fromKey(cascade_keys[light].key[first]), -fromKey(cascade_keys[light].key[first + 1]),
                fromKey(cascade_keys[light].key[first + 2]), fromKey(cascade_keys[light].key[first + 3]));
}

void main()
{
    GpuCascadeLight light = cascade_lights[gl_WorkGroupID.z];
    int i = int(gl_LocalInvocationID.x);
    if (i >= int(light.cascades.x)) {
        return;
    }
    const int first = kDepthKeys + kBoundKeys * i;
    GpuFittedView view;
    view.place = vec4(1.0, 1.0, 0.0, 0.0);
    view.seen = vec4(1.0, 1.0, -1.0, -1.0);
    view.slice = vec4(-1e30, 1e30, 0.0, 0.0);
    if (cascade_keys[gl_WorkGroupID.z].key[1] != 0u || light.cascades.z != 0u) { // else no pixel was seen, and there is nothing to divide
        vec3 slice = cascadeSlice(light, i);
        view.slice = vec4(slice.xy, slice.z > 0.0 ? 1.0 / slice.z : 0.0, 0.0);
    }
    vec4 shown = view.seen;
    if (cascade_keys[gl_WorkGroupID.z].key[first] != 0u) {
        view.seen = boundsFrom(first);
        shown = spareRoom(view.seen, boundsFrom(first + 4), light.room.xy);
    }
    vec2 x = axisPlace(shown.x, shown.z, light.split.z);
    vec2 y = axisPlace(shown.y, shown.w, light.split.w);
    vec2 scale = vec2(x.x, y.x);
    view.place = vec4(scale, vec2(x.y, y.y) + light.texel.zw / scale);
    view.slice.w = max(light.texel.x / x.x, light.texel.y / y.x);
    views[light.cascades.y + i] = view;
    report[light.cascades.y + i] = view;
}
