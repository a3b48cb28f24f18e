#version 460
// SPDX-License-Identifier: Apache-2.0
// Forward shading of a sun and a spot: the one function of Gnomon says how much of each reaches the surface.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_FILTER GNOMON_FILTER_EVSM
#include "gnomon/visibility.glsl"
#include "forward.glsl"

layout(location = 0) in vec3 p_eye;
layout(location = 1) in vec3 point;
layout(location = 0) out vec4 colour;

void main()
{
    vec3 n = normalize(cross(dFdx(p_eye), dFdy(p_eye)));
    n = dot(n, p_eye) > 0.0 ? -n : n;
    // All lanes ask before any is discarded: a filter may need its neighbours.
    float sun = gnomonLightVisibility(0u, p_eye, n, gl_FragCoord.xy);
    float spot = gnomonLightVisibility(1u, p_eye, n, gl_FragCoord.xy);
    if (draw.more.w > 0.0 && isHole(point)) {
        discard;
    }
    vec3 to_sun = gnomon_lights[0].place.xyz;
    vec3 to_spot = normalize(gnomon_lights[1].place.xyz - p_eye);
    float cone = smoothstep(0.83, 0.88, dot(-to_spot, gnomon_lights[1].size.yzw));
    vec3 light = vec3(0.08) + 0.6 * sun * max(dot(n, to_sun), 0.0) * vec3(1.0, 0.95, 0.85) +
                 0.6 * spot * cone * max(dot(n, to_spot), 0.0) * vec3(0.7, 0.8, 1.0);
    colour = vec4(draw.more.rgb * light, 1.0);
}
