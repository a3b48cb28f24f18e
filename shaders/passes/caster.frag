#version 460
// SPDX-License-Identifier: Apache-2.0
// The value that a caster writes to a map. WRITE_COLOUR: into a colour image; WRITE_DEPTH: into the depth image, where
// the rasteriser's depth is not the metric; PER_SAMPLE: at each sample; MASKED: with holes where its texture's alpha is
// low; BEHIND: only fragments behind the first surface.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/caster.glsl"

// CasterConstants.
layout(constant_id = 0) const int kHolding = kDepthAlone; // kDepthAlone or kDepthBytes: paired_depth.h
layout(constant_id = 1) const float kQuantum = 0.0; // BEHIND: largest error of first_surface
layout(constant_id = 2) const bool kColoured = false; // vertices have colours
layout(constant_id = 6) const bool kIds = false; // the map holds ids of objects
layout(constant_id = 7) const bool kParaboloid = false; // the map is one
layout(constant_id = 9) const bool kOwnDepth = false; // BEHIND: the rasteriser's depth is not the metric

#ifdef PER_SAMPLE
// The rasteriser's depth is each sample's own, and so must be the one that is written instead. All inputs are read at the
// sample then: the shader runs for each, and a texture's edge in a texel costs nothing more.
#define AT sample
#else
#define AT
#endif
// As caster.vert has them.
layout(location = 0) AT in float metric_in;
#ifdef WRITE_DEPTH
layout(location = 2) AT in vec3 rim;
layout(location = 6) AT in vec4 ray;
#endif
#ifdef WRITE_COLOUR
layout(location = 3) in float own;
layout(location = 4) flat in float id;
layout(location = 0) out vec4 stored;
#endif
#ifdef BEHIND
layout(set = 2, binding = 0) uniform sampler2D first_surface;
#endif
#ifdef MASKED
layout(location = 1) AT in vec2 uv;
layout(location = 5) AT in vec4 colour; // the vertices' colour
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
    float metric = metric_in;
#ifdef WRITE_DEPTH
    if (kParaboloid) {
        metric = casterRadial(rim, ray.xyz, dFdx(ray.xyz), dFdy(ray.xyz), ray.w);
        if (metric < 0.0) {
            discard;
        }
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
    float depth = casterStored(kOwnDepth ? metric : gl_FragCoord.z);
    if (!casterBehind(depth, texelFetch(first_surface, ivec2(gl_FragCoord.xy), 0).r, kQuantum)) {
        discard;
    }
    gl_FragDepth = depth;
#endif
#ifdef WRITE_COLOUR
    stored = kIds ? casterIdTexel(id, own) : casterTexel(kHolding, metric);
#endif
#ifdef WRITE_DEPTH
    gl_FragDepth = casterStored(metric);
#endif
}
