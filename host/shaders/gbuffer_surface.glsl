// SPDX-License-Identifier: Apache-2.0
// A surface of the G-buffer in one texel of four integers: a software rasteriser stores and fetches one texel faster
// than three of the same size together.
#ifndef HOST_GBUFFER_SURFACE_GLSL
#define HOST_GBUFFER_SURFACE_GLSL
#include "gnomon/shared/octahedral.h"

#ifdef HOST_MATERIAL_GLSL
// `second`: roughness, or what is stored of a Phong exponent.
uvec3 packSurface(Surface s, vec2 shading_normal, float second)
{
    return uvec3(packUnorm4x8(vec4(sqrt(s.base.rgb), s.occlusion)), packSnorm2x16(shading_normal),
                 packUnorm4x8(vec4(s.metallic, second, s.lit, s.model * 0.5)));
}
#endif

struct StoredSurface {
    vec4 base; // linear; occlusion
    vec3 shading_normal;
    float metallic;
    float second;
    float lit; // a window, when it is dark outside
    float model;
};

StoredSurface unpackSurface(uvec3 texel)
{
    StoredSurface s;
    s.base = unpackUnorm4x8(texel.x);
    s.base.rgb *= s.base.rgb;
    s.shading_normal = octahedralDecode(unpackSnorm2x16(texel.y));
    vec4 numbers = unpackUnorm4x8(texel.z);
    s.metallic = numbers.r;
    s.second = numbers.g;
    s.lit = numbers.b;
    s.model = floor(numbers.a * 2.0 + 0.5);
    return s;
}

#endif
