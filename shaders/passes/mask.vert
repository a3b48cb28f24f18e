#version 460
// SPDX-License-Identifier: Apache-2.0
// One triangle that covers the screen. WITH_NUMBERS: with what lib/mask_numbers.glsl lists; GNOMON_ONE_VIEW: and with its
// one view, or one of each position of the sun. WITH_SCREEN: with those of the screen alone.
#if defined(WITH_NUMBERS) || defined(WITH_SCREEN)
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/mask_numbers.glsl"
#include "gnomon/shared/gpu_structs.h"
layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants constants;
};
#endif
#ifdef WITH_SCREEN
layout(location = 0) flat out vec4 numbers[kScreenNumbers];
#endif
#ifdef WITH_NUMBERS
layout(set = 0, binding = 2, std430) restrict readonly buffer Lights
{
    GpuLight lights[];
};
#ifdef GNOMON_ONE_VIEW
layout(set = 0, binding = 8, std140) uniform FewViews
{
    GpuView views[kFewViews];
};
layout(push_constant) uniform Draw
{
    uint first_light;
};
#endif
layout(location = 0) flat out vec4 numbers[kMaskNumbers];
#endif

void main()
{
    vec2 p = vec2(float((gl_VertexIndex << 1) & 2), float(gl_VertexIndex & 2));
    gl_Position = vec4(p * 2.0 - 1.0, 0.0, 1.0);
#ifdef WITH_SCREEN
#define WRITE_SCREEN(PLACE, MEMBER) numbers[PLACE] = constants.screen.MEMBER;
    GNOMON_SCREEN_NUMBERS(WRITE_SCREEN)
    numbers[kDrawLayer] = vec4(float(gl_InstanceIndex));
#endif
#ifdef WITH_NUMBERS
#define WRITE(PLACE, MEMBER) numbers[PLACE] = constants.MEMBER;
    GNOMON_MASK_NUMBERS(WRITE)
#ifdef GNOMON_ONE_VIEW
    GpuLight light = lights[first_light];
#define WRITE_VIEW(PLACE, MEMBER) numbers[PLACE] = views[light.views.x].MEMBER;
    GNOMON_VIEW_NUMBERS(WRITE_VIEW)
#define WRITE_LATER(PLACE, MEMBER) numbers[PLACE + kLaterNumbers] = views[light.views.z].MEMBER;
    GNOMON_VIEW_NUMBERS(WRITE_LATER)
    numbers[kLightPlace] = light.place;
    numbers[kStepsPlace] = light.steps;
#else
    numbers[kLightPlace] = lights[0].place;
#endif
#endif
}
