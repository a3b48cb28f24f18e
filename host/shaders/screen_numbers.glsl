// SPDX-License-Identifier: Apache-2.0
// For fragment shaders behind screen.vert: numbers of the frame, by vertex or not. Included after frame.glsl.
#ifndef HOST_SCREEN_NUMBERS_GLSL
#define HOST_SCREEN_NUMBERS_GLSL
#include "by_vertex.glsl"

layout(location = 0) flat in vec4 numbers_in[kScreenNumberCount];
#define SCREEN_NUMBER(PLACE, MEMBER) (kByVertex ? numbers_in[PLACE] : frame.MEMBER)
#define FRAME_RAY_X SCREEN_NUMBER(kScreenRayX, ray_x)
#define FRAME_RAY_Y SCREEN_NUMBER(kScreenRayY, ray_y)
#define FRAME_RAY_0 SCREEN_NUMBER(kScreenRay0, ray_0)
#define FRAME_DEPTH SCREEN_NUMBER(kScreenDepth, depth)
#define FRAME_ZENITH SCREEN_NUMBER(kScreenZenith, sky_zenith)
#define FRAME_HORIZON SCREEN_NUMBER(kScreenHorizon, sky_horizon)
#define FRAME_GROUND SCREEN_NUMBER(kScreenGround, ground)

#endif
