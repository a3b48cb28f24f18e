// SPDX-License-Identifier: Apache-2.0
// A material's numbers and textures, and the surface they describe at a fragment.
#ifndef HOST_MATERIAL_GLSL
#define HOST_MATERIAL_GLSL
#include "material_data.glsl"

// The parts that the pipeline's materials need, so that plain ones pay for nothing.
layout(constant_id = 0) const bool kBaseTexture = false;
layout(constant_id = 1) const bool kEmits = false; // some material of the scene does
layout(constant_id = 2) const bool kAllTextures = false;

layout(set = 1, binding = 1) uniform sampler2D base_colour_texture;
layout(set = 1, binding = 2) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 3) uniform sampler2D normal_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 5) uniform sampler2D emissive_texture;

vec2 place(int i, vec4 uvs)
{
    TexturePlace at = material.places[i];
    if (i == 0) { // the place of the base colour, which most materials have alone
        at = TexturePlace(MATERIAL_PLACE_U, MATERIAL_PLACE_V);
    }
    vec2 uv = at.u.w > 0.5 ? uvs.zw : uvs.xy;
    return vec2(dot(at.u.xy, uv) + at.u.z, dot(at.v.xy, uv) + at.v.z);
}

struct Surface {
    vec4 base; // linear, coverage in a
    vec3 shading_normal;
    vec3 geometric_normal; // towards the eye
    float metallic;
    float roughness; // or the Phong exponent
    float occlusion;
    float lit; // a window, when it is dark outside
    float model;
};

vec4 baseColour(vec4 uvs, vec4 colour)
{
    vec4 base = MATERIAL_BASE * colour;
    if (kBaseTexture) {
        base *= texture(base_colour_texture, place(0, uvs));
    }
    return base;
}

vec3 emission(vec4 uvs)
{
    return kEmits ? material.emissive.rgb * texture(emissive_texture, place(4, uvs)).rgb : vec3(0.0);
}

// `p`: eye-relative position; `sight`: sightTo(p). The tangent's w is the handedness, 0 where there is no tangent.
Surface surfaceAt(vec3 p, vec3 sight, vec3 normal, vec4 tangent, vec4 uvs, vec4 base)
{
    Surface s;
    s.base = base;
    // Derivatives as shares of the distance, which no size of the scene changes.
    float k = inversesqrt(dot(p, p));
    vec3 n = cross(dFdx(p) * k, dFdy(p) * k);
    float l = dot(n, n);
    // A triangle seen edge on has no derivative worth the name.
    vec3 geometric = l > 1e-30 ? n * inversesqrt(l) : normalize(normal);
    s.geometric_normal = dot(geometric, sight) > 0.0 ? -geometric : geometric;
    n = normalize(normal);
    s.metallic = MATERIAL_NUMBERS.x;
    s.roughness = MATERIAL_NUMBERS.y;
    s.occlusion = 1.0;
    s.model = MATERIAL_MODEL.x;
    s.lit = MATERIAL_MODEL.z * (1.0 - base.a);
    if (kAllTextures) {
        if (tangent.w != 0.0) {
            vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz));
            vec3 b = cross(n, t) * tangent.w;
            vec3 m = texture(normal_texture, place(2, uvs)).xyz * (255.0 / 127.0) - 128.0 / 127.0;
            m.xy *= material.emissive.w;
            n = normalize(t * m.x + b * m.y + n * m.z);
        }
        vec4 mr = texture(metallic_roughness_texture, place(1, uvs));
        s.metallic *= mr.b;
        s.roughness *= mr.g;
        s.occlusion = 1.0 + MATERIAL_NUMBERS.z * (texture(occlusion_texture, place(3, uvs)).r - 1.0);
    }
    // One rule for back faces of two-sided surfaces and for mirrored objects.
    s.shading_normal = dot(n, s.geometric_normal) < 0.0 ? -n : n;
    return s;
}

#endif
