// SPDX-License-Identifier: Apache-2.0
// The output of a pass that shades.
#ifndef HOST_SHOWN_GLSL
#define HOST_SHOWN_GLSL
#include "tone.glsl"

layout(constant_id = 9) const bool kToned = false; // the light goes through the tone curve at once

vec4 shown(vec3 light, float alpha)
{
    if (kToned) {
        return encoded(toneOf(light), gl_FragCoord.xy); // as tone.frag
    }
    return vec4(light * alpha, alpha); // premultiplied
}

#endif
