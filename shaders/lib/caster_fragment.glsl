// SPDX-License-Identifier: Apache-2.0
// GLSL only: body of the caster fragment shaders.
#include "caster.glsl"

layout(location = 0) in float metric;
#ifdef WRITE_COLOUR
layout(location = 0) out float stored;
#endif
#ifdef MASKED
layout(location = 1) in vec2 uv;
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
#ifdef MASKED
    if (texture(base_colour, uv).a < cutoff) {
        discard;
    }
#endif
#ifdef WRITE_COLOUR
    stored = casterStored(metric);
#endif
#ifdef WRITE_DEPTH
    gl_FragDepth = casterStored(metric);
#endif
}
