#version 460
// SPDX-License-Identifier: Apache-2.0
// Puts the kept map of what stands still back under what moves.
layout(set = 0, binding = 0) uniform sampler2DArray kept_depths;
#ifdef WRITE_COLOUR
layout(set = 0, binding = 1) uniform sampler2DArray kept_colours;
layout(location = 0) out vec4 stored;
#endif
layout(push_constant) uniform Kept
{
    int layer;
};

void main()
{
    ivec3 texel = ivec3(ivec2(gl_FragCoord.xy), layer);
    gl_FragDepth = texelFetch(kept_depths, texel, 0).r;
#ifdef WRITE_COLOUR
    stored = texelFetch(kept_colours, texel, 0);
#endif
}
