#version 460
// SPDX-License-Identifier: Apache-2.0
// What a caster writes to a map. WRITE_COLOUR: into a colour image; WRITE_DEPTH: into the depth image, where the
// rasteriser's depth is not the metric; PARABOLOID: of such a
// map; MASKED: with holes where its texture's alpha is low; BEHIND: only what lies behind the
// first surface; IDS: into a colour image that holds ids of objects.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/caster.glsl"

#ifdef PER_SAMPLE
// The rasteriser's depth is each sample's own, and so must be the one that is written instead. All inputs are read at the
// sample then: the shader runs for each, and a texture's edge in a texel costs nothing more.
#define AT sample
#else
#define AT
#endif
#ifdef PARABOLOID
layout(location = 0) in vec4 ray; // caster.vert
layout(location = 2) in vec3 rim;
#else
layout(location = 0) AT in float metric;
#endif
#ifdef IDS
layout(location = 3) in float own;
layout(location = 4) flat in float id;
layout(location = 0) out vec4 stored;
#endif
#ifdef BEHIND
layout(set = 2, binding = 0) uniform sampler2D first_surface;
layout(constant_id = 1) const float kQuantum = 0.0;
#endif
#ifdef WRITE_COLOUR
layout(location = 0) out vec4 stored;
layout(constant_id = 0) const int kHolding = kDepthAlone;
#endif
#ifdef MASKED
layout(location = 1) AT in vec2 uv;
layout(location = 5) AT in vec4 colour; // of vertices
layout(constant_id = 2) const bool kColoured = false;
layout(set = 0, binding = 0) uniform sampler2D base_colour;
layout(push_constant) uniform Material
{
    vec4 uv_u;
    vec4 uv_v;
    float cutoff;
};
#endif

void main()
{
#ifdef PARABOLOID
    float metric = casterRadial(rim, ray.xyz, dFdx(ray.xyz), dFdy(ray.xyz), ray.w);
    if (metric < 0.0) {
        discard;
    }
#endif
#ifdef MASKED
    // The finest level, whatever the texel's size: coarser ones hold means, which for sparse leaves all fall below the cutoff,
    // and the shadow would vanish as texels grow. A texel in or out by one sample is right on average.
    if (textureLod(base_colour, uv, 0.0).a * (kColoured ? colour.a : 1.0) < cutoff) {
        discard;
    }
#endif
#ifdef BEHIND
#ifdef WRITE_DEPTH
    float depth = casterStored(metric);
#else
    float depth = casterStored(gl_FragCoord.z);
#endif
    if (!casterBehind(depth, texelFetch(first_surface, ivec2(gl_FragCoord.xy), 0).r, kQuantum)) {
        discard;
    }
#endif
#ifdef WRITE_COLOUR
    stored = casterTexel(kHolding, metric);
#endif
#ifdef IDS
    stored = casterIdTexel(id, own);
#endif
#ifdef WRITE_DEPTH
    gl_FragDepth = casterStored(metric);
#endif
}
