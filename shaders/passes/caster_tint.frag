#version 460
// SPDX-License-Identifier: Apache-2.0
// The value that a blended caster writes to a map of tints: the factor of the light behind it, by colour, and its
// depth, of which the nearest stays.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/blended_tint.h"
#include "gnomon/lib/caster.glsl"

layout(constant_id = 2) const bool kColoured = false; // CasterConstants
layout(constant_id = 7) const bool kParaboloid = false; // the map is one
layout(location = 0) in float metric_in; // as caster.vert has them
layout(location = 1) in vec2 uv;
layout(location = 2) in vec3 rim;
layout(location = 5) in vec4 colour_of_vertices;
layout(location = 6) in vec4 ray;
layout(set = 0, binding = 0) uniform sampler2D base_colour;
layout(push_constant) uniform Material
{
    vec4 uv_u;
    vec4 uv_v;
    float stained; // in the place of a masked caster's cutoff
    int first_view;
    layout(offset = 48) vec4 tint;
};
layout(location = 0) out vec4 stored;

void main()
{
    float metric = metric_in;
    if (kParaboloid) {
        metric = casterRadial(rim, ray.xyz, dFdx(ray.xyz), dFdy(ray.xyz), ray.w);
        if (metric < 0.0) {
            discard;
        }
    }
    vec4 all = texture(base_colour, uv) * tint;
    vec4 colour = clamp(kColoured ? all * colour_of_vertices : all, 0.0, 1.0);
    float depth = casterStored(metric);
    stored = vec4(blendedTint(colour, stained), depth);
    gl_FragDepth = depth;
}
