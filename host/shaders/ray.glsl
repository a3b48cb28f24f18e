// SPDX-License-Identifier: Apache-2.0
// Included after screen_numbers.glsl or scene_numbers.glsl.
#ifndef HOST_RAY_GLSL
#define HOST_RAY_GLSL

// Eye-relative position of what is at this pixel at view depth 1.
vec3 rayOf(vec2 pixel) { return FRAME_RAY_X.xyz * pixel.x + FRAME_RAY_Y.xyz * pixel.y + FRAME_RAY_0.xyz; }

#endif
