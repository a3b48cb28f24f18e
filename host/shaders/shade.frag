// SPDX-License-Identifier: Apache-2.0
// Deferred shading of every surface pixel: hemisphere light, and each light times its visibility.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"
#include "shared/octahedral.h"

layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2D bases;
layout(set = 0, binding = 3) uniform sampler2D normals;
layout(set = 0, binding = 4) uniform sampler2D materials;
layout(set = 0, binding = 6) uniform sampler2DArray mask;
layout(set = 0, binding = 7) uniform sampler2DArray cookies;
layout(location = 0) out vec4 out_light;

float visibilityOf(LightData light, ivec2 pixel)
{
    int slot = int(light.right.w);
    return texelFetch(mask, ivec3(pixel, slot >> 2), 0)[slot & 3];
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 base = texelFetch(bases, pixel, 0);
    base.rgb *= base.rgb;
    vec4 numbers = texelFetch(materials, pixel, 0);
    float model = floor(numbers.a * 2.0 + 0.5);
    if (model == 2.0) {
        out_light = vec4(base.rgb * frame.sky_horizon.w, 1.0);
        return;
    }
    float depth = texelFetch(depths, pixel, 0).r;
    vec3 p = rayOf(gl_FragCoord.xy) / (frame.depth.x * depth + frame.depth.y);
    vec3 n = octahedralDecode(texelFetch(normals, pixel, 0).ba);
    float second = model == 1.0 ? exp2(numbers.g * 16.0) - 1.0 : numbers.g;
    Lit s = litSurface(p, n, base.rgb, numbers.r, second, model);
    vec3 sum = ambient(s, model == 1.0 ? 1.0 : numbers.g, base.a);
    for (uint i = 0; i < frame.counts.x; ++i) {
        vec3 l;
        vec3 e = arriving(frame.lights[i], p, cookies, l);
        float n_l = dot(n, l);
        if (n_l > 0.0) {
            float seen = frame.counts.y != 0 ? visibilityOf(frame.lights[i], pixel) : 1.0;
            sum += reflectance(s, l, n_l) * e * (n_l * seen);
        }
    }
    out_light = vec4(sum, 1.0);
}
