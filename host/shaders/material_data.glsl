// SPDX-License-Identifier: Apache-2.0
#ifndef HOST_MATERIAL_DATA_GLSL
#define HOST_MATERIAL_DATA_GLSL

struct TexturePlace {
    vec4 u; // u' = dot(u.xy, uv) + u.z; w: 1 takes the second set of coordinates
    vec4 v;
};
// Laid out as host/src/materials.h has it.
layout(set = 1, binding = 0, std140) uniform MaterialData
{
    vec4 base_colour;
    vec4 emissive; // w: normal scale
    vec4 numbers;  // metallic, roughness, occlusion strength, alpha cutoff
    vec4 model;    // x: 0 metallic-roughness, 1 phong, 2 unlit; y: phong exponent; z: scene::Material::lit_by_night
    TexturePlace places[5];
}
material;

#endif
