// SPDX-License-Identifier: Apache-2.0
// The light that a light of the frame adds to a surface. Facts about a frame's lights and materials are constants.
#ifndef HOST_SHADED_LIGHTS_GLSL
#define HOST_SHADED_LIGHTS_GLSL
#include "lighting.glsl"

// The number of the frame's lights when they are few: unrolled loops read uniforms at fixed places, which a software
// rasteriser does once for all pixels. 0: any number.
layout(constant_id = 4) const int kFixedLights = 0;
layout(constant_id = 5) const bool kDirectionalOnly = false;
layout(constant_id = 6) const bool kPhysicalOnly = false; // every surface is metallic-roughness
layout(constant_id = 7) const bool kPhong2005 = false;    // Reflection::phong_2005

// `seen`: the share of each colour that reaches the surface.
vec3 lightFrom(LightData light, Lit s, sampler2DArray cookies, vec3 seen)
{
    vec3 l = light.place.xyz;
    vec3 e = light.colour.rgb;
    if (!kDirectionalOnly) {
        e = arriving(light, s.p, cookies, l);
    }
    float n_l = max(dot(s.n, l), 0.0);
    if (kPhong2005) {
        return s.diffuse * e * (seen * (n_l + reflectionPhong(s, l, n_l)));
    }
    return reflectance(s, l, n_l) * e * (n_l * seen);
}

#endif
