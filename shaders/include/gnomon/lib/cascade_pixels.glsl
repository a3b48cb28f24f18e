// SPDX-License-Identifier: Apache-2.0
// GLSL only: what the passes over the camera's depth buffer that fit cascades have in common. The light's number is the
// group's z.
#extension GL_EXT_samplerless_texture_functions : require
#include "../shared/cascade_fit.h"
#include "../shared/gpu_cascades.h"

layout(set = 0, binding = 0, std430) readonly buffer Lights
{
    GpuCascadeLight cascade_lights[];
};
layout(set = 0, binding = 1, std430) buffer Keys
{
    GpuCascadeKeys cascade_keys[];
};

// Grows with the number, and is above 0.
uint greatestKey(float v)
{
    uint bits = floatBitsToUint(v);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float fromKey(uint key)
{
    return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key);
}

// Where cascade i of a light begins if nothing faded.
float cascadeSplit(GpuCascadeLight light, int i)
{
    if (light.cascades.z != 0u) {
        return i == 0 ? 0.0 : light.ends[(i - 1) >> 2][(i - 1) & 3];
    }
    SplitRange range =
        splitRange(-fromKey(cascade_keys[gl_WorkGroupID.z].key[0]), fromKey(cascade_keys[gl_WorkGroupID.z].key[1]),
                                  light.split.x, light.cascades.w != 0u);
    return splitAt(range, i, int(light.cascades.x));
}

// x: begin, y: end, z: width of the blend. The first and the last serve what lies before and behind all splits too.
vec3 cascadeSlice(GpuCascadeLight light, int i)
{
    const float endless = 1e30;
    float begin = cascadeSplit(light, i);
    float blend = i == 0 ? 0.0 : blendWidth(light.split.y, cascadeSplit(light, i - 1), begin);
    return vec3(i == 0 ? -endless : begin - blend,
                i + 1 == int(light.cascades.x) ? endless : cascadeSplit(light, i + 1), blend);
}

#ifdef PIXELS
layout(set = 0, binding = 4) uniform texture2D depths;
layout(set = 0, binding = 5) uniform utexture2D object_ids;
layout(constant_id = 0) const bool kHasIds = false; // else object_ids is a stand-in

// A surface that may be shadowed: where it lies on the base map, and how deep.
struct Seen {
    bool counts;
    float depth_m;
    vec2 place;
    vec2 room; // on all sides of it
};

Seen seenAt(GpuCascadeLight light, ivec2 pixel)
{
    Seen seen = Seen(false, 0.0, vec2(0.0), vec2(0.0));
    if (any(greaterThanEqual(vec2(pixel), light.screen.xy))) {
        return seen;
    }
    float depth = texelFetch(depths, pixel, 0).x;
    if (depth == light.reach.x) {
        return seen;
    }
    if (kHasIds && texelFetch(object_ids, pixel, 0).x == 0u) {
        return seen;
    }
    vec4 ndc = vec4((vec2(pixel) + 0.5) * light.screen.zw * 2.0 - 1.0, depth, 1.0);
    vec4 h = vec4(dot(light.eye_x, ndc), dot(light.eye_y, ndc), dot(light.eye_z, ndc), dot(light.eye_w, ndc));
    vec4 p = vec4(h.xyz / h.w, 1.0);
    float w = dot(light.base_w, p);
    vec2 place = vec2(dot(light.base_x, p), dot(light.base_y, p)) / w;
    // Comparisons that hold for numbers only: what is none does not count.
    seen.counts = w > 0.0 && abs(place.x) <= light.reach.z && abs(place.y) <= light.reach.w &&
                  dot(p.xyz, p.xyz) <= light.reach.y * light.reach.y;
    seen.depth_m = dot(light.view_axis.xyz, p.xyz);
    seen.place = place;
    seen.room = light.room.xy / (light.room.z > 0.0 ? w : 1.0);
    return seen;
}

// A thread looks at several pixels: what it reads of the light, and its atomics, which software does one by one, are
// for all of them. The i-th of kBoundsPixels^2.
ivec2 pixelOf(int i)
{
    ivec2 block = ivec2(gl_WorkGroupID.xy) * kBoundsPixels + ivec2(i % kBoundsPixels, i / kBoundsPixels);
    return block * kBoundsGroup + ivec2(gl_LocalInvocationID.xy);
}
#endif
