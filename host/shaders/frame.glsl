// SPDX-License-Identifier: Apache-2.0
// Numbers that every pass of a frame reads. Positions are relative to the eye: world space moved, not turned.
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
    // Eye-relative position of pixel p at view depth d: (ray_x * p.x + ray_y * p.y + ray_0) * d; of an orthographic
    // camera that without the d, and d along the view (ray.glsl). w of the first: radius of ambient occlusion, m. The
    // others' w, where the camera is orthographic: view depth = ray_y.w * stored depth + ray_0.w; else 0.
    vec4 ray_x;
    vec4 ray_y;
    vec4 ray_0;
    vec4 depth; // perspective: 1 / view depth = x * stored depth + y; z: 1 when there is a mask; w: light of lit windows
    // The sky's light by a surface's normal: for red, green and blue a row of (x, y, z, 1) each, then one of (xy, yz,
    // yy, xz) each, then the factors of xx - zz; w of the last: exposure of emitted light.
    vec4 skylight[7];
    vec4 sky[7];  // for the pass that draws the sky: sky_numbers.glsl
    uvec4 counts; // x: lights
    LightData lights[kMaxLights];
}
frame;


#endif
