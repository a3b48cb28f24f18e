#version 460
// SPDX-License-Identifier: Apache-2.0
// DEPTH: views whose formats say write_frag_depth. MASKED: things with holes. Without both there is no fragment shader.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/caster.glsl"
#include "forward.glsl"

layout(location = 0) sample in float metric;
layout(location = 1) in vec3 point;

void main()
{
#ifdef MASKED
    if (isHole(point)) {
        discard;
    }
#endif
#ifdef DEPTH
    gl_FragDepth = gnomonCasterDepth(metric);
#endif
}
