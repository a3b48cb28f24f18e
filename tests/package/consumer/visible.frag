#version 460
// SPDX-License-Identifier: Apache-2.0
// The includes of a host's shaders, found beside the installed headers.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/visibility.glsl"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 0) out float seen;

void main()
{
    seen = gnomonLightVisibility(0u, point, normal, gl_FragCoord.xy);
}
