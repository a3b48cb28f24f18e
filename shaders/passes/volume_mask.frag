#version 460
// SPDX-License-Identifier: Apache-2.0
// A light's channel of the mask, where its shadow volumes have been counted: drawn once for what is outside of all of
// them and once for what is inside of some.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/facing.glsl"
#include "gnomon/shared/moment_rule.h"

layout(constant_id = 0) const bool kHasNormals = true; // normals is no stand-in
layout(constant_id = 1) const bool kHasSmooth = false; // smooth_surfaces is no stand-in
layout(constant_id = 2) const bool kIsInside = false; // draws what is inside of some volume
layout(constant_id = 3) const bool kHasIds = false; // else object_ids is a stand-in
layout(push_constant) uniform Push
{
    vec4 place; // the light's place, GpuLight::place
};
layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants constants;
};
layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2D normals;
layout(set = 0, binding = 3) uniform sampler2D smooth_surfaces;
layout(set = 0, binding = 4) uniform usampler2D object_ids;
layout(location = 0) out vec4 visibility;

#define GNOMON_SURFACE_SCREEN constants.screen
#include "gnomon/lib/screen_surface.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).r;
    if (depth == constants.screen.fade.z) {
        discard; // undrawn pixels stay lit
    }
    if (kHasIds && texelFetch(object_ids, pixel, 0).r == 0) {
        discard;
    }
    vec3 p = positionAt(pixel, depth);
    vec3 n = kHasNormals ? octahedralDecode(texelFetch(normals, pixel, 0).rg) : normalFromDepth(pixel, depth, p);
    SmoothSurface s = kHasSmooth ? smoothDecode(texelFetch(smooth_surfaces, pixel, 0).rgb, p, n) : flatSurface(n);
    LightPoint at = lightPoint(p, n, s, towardLight(place, p), 0.0); // whose edges are those of a point
    vec2 lighten = constants.rule.moment_shape.zw;
    float shaded = lightenedVisibility(kIsInside ? 0.0 : 1.0, lighten.x, lighten.y);
    vec4 v = vec4(mix(shaded, 1.0, fadedShare(constants.screen.fade, length(p))));
    visibility = min(v, vec4(at.share));
}
