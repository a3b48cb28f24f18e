// SPDX-License-Identifier: Apache-2.0
// Lines of sight. Included after screen_numbers.glsl or scene_numbers.glsl.
#ifndef HOST_RAY_GLSL
#define HOST_RAY_GLSL

bool isOrthographic() { return FRAME_RAY_Y.w != 0.0; }

// Unit, the way the camera looks.
vec3 viewAxis() { return normalize(cross(FRAME_RAY_X.xyz, FRAME_RAY_Y.xyz)); }

// Eye-relative position of what is at this pixel at view depth 1; of an orthographic camera at 0.
vec3 rayOf(vec2 pixel) { return FRAME_RAY_X.xyz * pixel.x + FRAME_RAY_Y.xyz * pixel.y + FRAME_RAY_0.xyz; }

vec3 pointOn(vec2 pixel, float view_depth)
{
    vec3 ray = rayOf(pixel);
    return isOrthographic() ? ray + viewAxis() * view_depth : ray * view_depth;
}

// The way from the eye through an eye-relative point, of any length.
vec3 sightTo(vec3 p) { return isOrthographic() ? viewAxis() : p; }
vec3 sightThrough(vec2 pixel) { return isOrthographic() ? viewAxis() : rayOf(pixel); }

// View depth of a stored depth, of which `over_w` is 1 / view depth where the camera is a perspective one.
float viewDepthOf(float stored, float over_w)
{
    return isOrthographic() ? FRAME_RAY_Y.w * stored + FRAME_RAY_0.w : 1.0 / over_w;
}

// Side of a pixel at a view depth, m.
float pixelAt(float view_depth) { return length(FRAME_RAY_X.xyz) * (isOrthographic() ? 1.0 : view_depth); }

#endif
