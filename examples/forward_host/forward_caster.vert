#version 460
// SPDX-License-Identifier: Apache-2.0
// The forward host's casters. Any vertex shader will do that ends like this.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/caster.glsl"
#include "forward.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out float metric;
layout(location = 1) out vec3 point;

void main()
{
    vec3 p_ws = draw.centre.xyz + draw.half_size.xyz * position;
    gl_Position = draw.clip_from * vec4(p_ws, 1.0);
    metric = gnomonCasterMetric(p_ws, draw.more);
    point = position;
}
