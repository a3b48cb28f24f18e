// SPDX-License-Identifier: Apache-2.0
// Light reflected towards the eye.
// Based on: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007 (GGX); E. Heitz,
// "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", 2014 (height-correlated Smith);
// C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994; B. Karis, "Physically Based Shading on
// Mobile", 2014 (the hemisphere's specular share); KHR_lights_punctual, 2018 (cone and range).
#ifndef HOST_LIGHTING_GLSL
#define HOST_LIGHTING_GLSL
// The includer defines FRAME_SKYLIGHT: screen_numbers.glsl.

const float kPi = 3.14159265358979;

// A surface ready to be lit.
struct Lit {
    vec3 p; // eye-relative
    vec3 n;
    vec3 v; // towards the eye
    vec3 diffuse;
    vec3 f0;
    float alpha; // squared roughness; Phong: the exponent
    float n_v;
    bool phong;
};

// `p`: eye-relative position; `to_eye`: of any length.
Lit litSurface(vec3 p, vec3 to_eye, vec3 n, vec3 base, float metallic, float roughness, float model)
{
    Lit s;
    s.p = p;
    s.v = normalize(to_eye);
    s.n = n;
    s.n_v = max(dot(n, s.v), 1e-4);
    s.phong = model == 1.0;
    if (s.phong) {
        s.diffuse = base;
        s.f0 = vec3(0.04);
        s.alpha = roughness;
    } else {
        s.diffuse = base * (1.0 - metallic) * 0.96;
        s.f0 = mix(vec3(0.04), base, metallic);
        s.alpha = max(roughness * roughness, 0.002);
    }
    return s;
}

// Times pi: a light of illuminance pi on a white surface gives 1, which saves a division per light.
vec3 reflectance(Lit s, vec3 l, float n_l)
{
    vec3 h = normalize(s.v + l);
    float n_h = clamp(dot(s.n, h), 0.0, 1.0);
    if (s.phong) {
        // Phong 1975 as Blinn 1977 has it, scaled to reflect no more than it gets (Lewis 1994).
        return s.diffuse + s.f0 * ((s.alpha + 8.0) / 8.0) * pow(n_h, s.alpha);
    }
    float a2 = s.alpha * s.alpha;
    float d = (n_h * a2 - n_h) * n_h + 1.0;
    float smith = n_l * sqrt((s.n_v - s.n_v * a2) * s.n_v + a2) + s.n_v * sqrt((n_l - n_l * a2) * n_l + a2);
    float x = 1.0 - clamp(dot(s.v, l), -1.0, 1.0) * 0.5 - 0.5; // (1 - cos(v, l)) / 2 = (1 - v.h)(1 + v.h)
    float v_h = sqrt(max(1.0 - x, 0.0));
    float one = 1.0 - v_h;
    float one2 = one * one;
    vec3 f = s.f0 + (1.0 - s.f0) * (one2 * one2 * one);
    return s.diffuse + f * (a2 * 0.5 / max(d * d * smith, 1e-7));
}

// The specular term of A. S. Shastry, "Soft-Edged Shadows", 2005: of the reflected ray (Phong 1975), none where the
// surface faces away.
float reflectionPhong(Lit s, vec3 l, float n_l)
{
    float along = max(dot(2.0 * n_l * s.n - l, s.v), 0.0);
    return n_l > 0.0 ? pow(along, 8.0) : 0.0;
}

// Illuminance that a light gives a point (over pi), before the cosine and shadow. `l`: towards the light.
vec3 arriving(LightData light, vec3 p, sampler2DArray cookies, out vec3 l)
{
    if (light.place.w < 0.5) {
        l = light.place.xyz;
        return light.colour.rgb;
    }
    vec3 to = light.place.xyz - p;
    float d2 = max(dot(to, to), 1e-9 * dot(p, p)); // as if it were never nearer than a share of the way to the eye
    l = to * inversesqrt(d2);
    float q = d2 * light.colour.w * light.colour.w;
    float window = clamp(1.0 - q * q, 0.0, 1.0);
    vec3 e = light.colour.rgb * (window / d2);
    if (light.place.w < 1.5) {
        float along = -dot(l, light.axis.xyz);
        float cone = clamp(along * light.cone.x + light.cone.y, 0.0, 1.0);
        e *= cone * cone;
        if (light.axis.w >= 0.0) {
            vec3 down = cross(light.axis.xyz, light.right.xyz);
            float scale = 0.5 * light.cone.z / max(along, 1e-3);
            vec2 uv = 0.5 - vec2(dot(l, light.right.xyz), dot(l, down)) * scale;
            e *= textureLod(cookies, vec3(uv, light.axis.w), 0.0).rgb;
        }
    }
    return e;
}

// The light of sky and ground on a white surface that faces this way (Skylight::on).
vec3 hemisphere(vec3 n)
{
    vec4 linear = vec4(n, 1.0);
    vec4 square = n.xyyx * n.yzyz;
    vec3 light = vec3(dot(FRAME_SKYLIGHT(0), linear) + dot(FRAME_SKYLIGHT(3), square),
                      dot(FRAME_SKYLIGHT(1), linear) + dot(FRAME_SKYLIGHT(4), square),
                      dot(FRAME_SKYLIGHT(2), linear) + dot(FRAME_SKYLIGHT(5), square));
    return max(light + FRAME_SKYLIGHT(6).rgb * (n.x * n.x - n.z * n.z), 0.0);
}

// Behind a pane when it is dark outside; `lit`: StoredSurface::lit.
vec3 lampLight(float lit) { return vec3(1.0, 0.56, 0.22) * (lit * FRAME_DEPTH.w); }

// `seen`: the share of the sky that is not hidden, of each colour; `mirrored`: of what is reflected.
vec3 ambient(Lit s, float roughness, vec3 seen, float mirrored)
{
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(r.x * r.x, exp2(-9.28 * s.n_v)) * r.x + r.y;
    vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
    vec3 specular = (s.f0 * ab.x + ab.y) * hemisphere(reflect(-s.v, s.n));
    return s.diffuse * hemisphere(s.n) * seen + specular * mirrored;
}

#endif
