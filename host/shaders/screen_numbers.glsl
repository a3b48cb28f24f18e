// SPDX-License-Identifier: Apache-2.0
// For fragment shaders behind screen.vert: numbers of the frame, by vertex or not. Included after frame.glsl.
#ifndef HOST_SCREEN_NUMBERS_GLSL
#define HOST_SCREEN_NUMBERS_GLSL
#include "by_vertex.glsl"

layout(location = 0) flat in vec4 numbers_in[kScreenNumberCount];
layout(location = kScreenPixel) in vec2 place_in;
#define SCREEN_NUMBER(PLACE, MEMBER) (kInSoftware ? numbers_in[PLACE] : frame.MEMBER)
#define FRAME_RAY_X SCREEN_NUMBER(kScreenRayX, ray_x)
#define FRAME_RAY_Y SCREEN_NUMBER(kScreenRayY, ray_y)
#define FRAME_RAY_0 SCREEN_NUMBER(kScreenRay0, ray_0)
#define FRAME_DEPTH SCREEN_NUMBER(kScreenDepth, depth)
#define FRAME_SKYLIGHT(I) SCREEN_NUMBER(kScreenSky + (I), skylight[I])
#define FRAME_SKY(I) SCREEN_NUMBER(kScreenSky + (I), sky[I]) // for the pass that draws the sky

// The pixel's own texel of an image that is as large as the picture and has a nearest sampler [drivers: mip].
vec4 texelHere(sampler2D image)
{
    return kInSoftware ? textureLod(image, place_in, 0.0) : texelFetch(image, ivec2(gl_FragCoord.xy), 0);
}
uvec4 texelHere(usampler2D image)
{
    return kInSoftware ? textureLod(image, place_in, 0.0) : texelFetch(image, ivec2(gl_FragCoord.xy), 0);
}
vec4 texelHere(sampler2DArray image, int layer)
{
    return kInSoftware ? textureLod(image, vec3(place_in, layer), 0.0)
                     : texelFetch(image, ivec3(gl_FragCoord.xy, layer), 0);
}

#endif
