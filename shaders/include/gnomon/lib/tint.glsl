// SPDX-License-Identifier: Apache-2.0
// GLSL only: what blended casters leave of a light. A map of tints has beside each map the product of what they let
// through, and the depth of the nearest of them: a receiver before that is not tinted. Define GNOMON_TINTS_BINDING.
// Based on: T. Lokovic, E. Veach, "Deep Shadow Maps", SIGGRAPH 2000, of whose functions of depth this is the one with a
// single step. So a receiver between two panes is tinted by both, unless it casts itself.
#ifndef GNOMON_TINT_GLSL
#define GNOMON_TINT_GLSL
#include "visibility.glsl"

layout(set = GNOMON_SET, binding = GNOMON_TINTS_BINDING) uniform sampler2DArray gnomon_tints;

// Compared as filters compare: with the depth that the receiver's plane has at the texel, lest a blended surface that
// leans to the light lies behind itself; and a step of the map's depth is no depth.
vec3 tintTexel(vec2 texel, float layer, MapPoint point, vec3 own)
{
    vec4 tint = texelFetch(gnomon_tints, ivec3(texel, layer), 0);
    float before = compareTexel(point, texel + 0.5 - point.texel, tint.a + 1.0 / 65535.0);
    return before > 0.0 ? vec3(1.0) : min(tint.rgb / own, 1.0);
}

// The share of white light that arrives at a receiver: red, green, blue, and their luminance (ITU-R BT.709). `point`:
// projectReceiver() of it. Bilinear; each texel is compared on its own. `own_tint`: the factor by which the surface
// itself dims the light behind it. It is a factor of the stored product and is divided out. 0 cannot be, so a surface
// that lets nothing through is lit where it is the nearest, and dark behind another.
vec4 viewTint(GpuView view, MapPoint point, vec3 own_tint)
{
    float layer = view.more.w - 1.0;
    if (layer < 0.0) {
        return vec4(1.0);
    }
    vec2 first = floor(point.texel - 0.5);
    vec2 share = point.texel - 0.5 - first;
    vec3 own = max(own_tint, vec3(1.0 / 65535.0)); // the map's step
    vec3 tint = vec3(0.0);
    for (int i = 0; i < 4; ++i) { // not four times in the module
        vec2 corner = vec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - share, share, corner);
        vec2 texel = clamp(first + corner, view.whole.xy, view.whole.zw - 1.0);
        tint += weight.x * weight.y * tintTexel(texel, layer, point, own);
    }
    return vec4(tint, dot(tint, vec3(0.2126, 0.7152, 0.0722)));
}

#endif
