// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion of every second pixel of every second row: see ambient_occlusion.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "ray.glsl"
#include "gnomon/shared/octahedral.h"
#include "ambient_occlusion.h"
#include "occlusion_texel.glsl"

layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 9) uniform sampler2D normals;
layout(location = 0) out uint out_seen;

const float kMostReach = 0.3;       // share of the picture's height: nearer to the eye the radius is less
const float kLeastReachPixels = 1.0; // a radius that is smaller on the screen fades away

vec2 pictureSize() { return vec2(textureSize(depths, 0)); }

// The sky hides nothing, though the far plane may be near.
const float kSky_m = 1e9;
float viewDepthAt(vec2 middle)
{
    float stored = textureLod(depths, middle / pictureSize(), 0.0).r;
    return stored > 0.0 ? viewDepthOf(stored, FRAME_DEPTH.x * stored + FRAME_DEPTH.y) : kSky_m;
}

// A point and what its slices share.
struct Seen {
    vec2 middle; // pixels
    vec3 p;
    vec3 v; // towards the eye
    vec3 normal;
    float radius;
    float reach; // the radius in pixels
    float shift; // the shift of the steps
};

// Steps grow with their distance, for what is near hides most.
float horizonTo(Seen s, vec2 direction, float own, float part)
{
    float horizon = own;
    for (int i = 0; i < kOcclusionSteps; ++i) {
        float t = (float(i) + s.shift) / float(kOcclusionSteps);
        vec2 at = floor(s.middle + direction * max(t * t * s.reach, float(i) + 1.0)) + 0.5;
        vec3 to = pointOn(at, viewDepthAt(at)) - s.p;
        float distance = length(to);
        bool outside = any(lessThan(at, vec2(0.0))) || any(greaterThan(at, pictureSize()));
        float weight = outside ? 0.0 : occluderWeight(distance, s.radius);
        float risen = risenHorizon(own, dot(to, s.normal) / max(distance * part, 1e-9));
        float cosine = mix(own, risen, weight);
        horizon = raisedHorizon(horizon, cosine, kOcclusionThickness * weight);
    }
    return horizon;
}

vec2 slice(Seen s, vec2 direction)
{
    vec3 along = FRAME_RAY_X.xyz * direction.x + FRAME_RAY_Y.xyz * direction.y;
    along = normalize(along - s.v * dot(along, s.v));
    float n_along = dot(s.normal, along);
    float n_up = dot(s.normal, s.v);
    float part = length(vec2(n_along, n_up));
    vec2 cosines = vec2(horizonTo(s, direction, ownHorizon(n_along, n_up), part),
                        horizonTo(s, -direction, ownHorizon(-n_along, n_up), part));
    return sliceLight(n_along, n_up, cosines);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    Seen s;
    s.middle = min(vec2(at * 2) + 0.5, pictureSize() - 0.5);
    float view_depth = viewDepthAt(s.middle);
    s.p = pointOn(s.middle, view_depth);
    s.v = normalize(-sightTo(s.p));
    float pixel_m = pixelAt(view_depth);
    s.reach = min(FRAME_RAY_X.w / pixel_m, kMostReach * pictureSize().y);
    s.radius = s.reach * pixel_m;
    s.normal = octahedralDecode(textureLod(normals, s.middle / pictureSize(), 0.0).xy);
    vec2 pattern = occlusionPattern(at.x, at.y);
    s.shift = pattern.y;
    vec2 light = vec2(0.0);
    for (int i = 0; i < kOcclusionSlices; ++i) {
        float turn = (pattern.x + float(i)) * (2.0 / float(kOcclusionSlices)) * kOcclusionHalfPi;
        light += slice(s, vec2(cos(turn), sin(turn)));
    }
    float seen = light.x / max(light.y, 1e-4);
    seen = mix(1.0, seen, clamp(s.reach - kLeastReachPixels, 0.0, 1.0));
    // Where there is no surface its normal is whatever lies there, and neighbours would take it in.
    out_seen = packSeen(view_depth, view_depth < kSky_m ? seen : 1.0);
}
