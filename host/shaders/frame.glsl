// SPDX-License-Identifier: Apache-2.0
// What every pass of a frame reads. Positions are relative to the eye: world space moved, not turned.
#ifndef HOST_FRAME_GLSL
#define HOST_FRAME_GLSL

// Laid out as host/src/frame_data.h has it.
struct LightData {
    vec4 place;  // spot, point: xyz eye-relative position; directional: xyz unit, towards the light. w: 0, 1 spot, 2 point
    vec4 colour; // rgb: exposed illuminance or intensity; w: 1 / range, 0 without limit
    vec4 axis;   // xyz: unit, the way the light travels; w: layer of the cookie, -1 none
    vec4 cone;   // x scale, y offset of the cosine; z: cotangent of the outer angle
    vec4 right;  // xyz: unit, the cookie's +u; w: mask layer * 8 + channel, + 4 where the layer has colours
};
const int kMaxLights = 128;

layout(set = 0, binding = 0, std140) uniform FrameData
{
    mat4 clip_from_eye;
    vec4 ray_x; // eye-relative position of pixel p at view depth d: (ray_x * p.x + ray_y * p.y + ray_0) * d
    vec4 ray_y;
    vec4 ray_0;
    vec4 depth;       // 1 / view depth = x * stored depth + y; z: 1 when there is a mask
    vec4 sky_zenith;  // w: strength of the hemisphere light
    vec4 sky_horizon; // w: exposure of what is emitted
    vec4 ground;
    uvec4 counts; // x: lights
    LightData lights[kMaxLights];
}
frame;


#endif
