#version 460
// SPDX-License-Identifier: Apache-2.0
// Joins this frame's mask with the mean of the frames before it, where these saw the same surface and nothing that moved
// can have changed its light. gnomon/shared/converge.h has the sources.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/reprojection.glsl"
#include "gnomon/shared/converge.h"
#include "gnomon/shared/gpu_converge.h"
#include "gnomon/shared/gpu_structs.h"
#include "gnomon/shared/octahedral.h"

// The camera stands and nothing moved: then a pixel is joined with itself alone, and what follows for others need not be
// compiled [drivers: both-sides].
layout(constant_id = 0) const bool kAtRest = false; // what was seen before lies at the same pixel

layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants gnomon;
};
layout(set = 0, binding = 1, std430) restrict readonly buffer Layers
{
    GpuConverge layers[];
};
layout(set = 0, binding = 2) uniform sampler2D depths;
layout(set = 0, binding = 3) uniform sampler2D normals;
layout(set = 0, binding = 4) uniform sampler2DArray visibility_now;
layout(set = 0, binding = 5) uniform sampler2DArray mean_before;
layout(set = 0, binding = 6) uniform usampler2DArray surface_before;
layout(push_constant) uniform Push
{
    int layer;
};
layout(location = 0) out vec4 visibility;
layout(location = 1) out vec4 mean;
layout(location = 2) out uvec2 surface; // x: packSurface(); y: by light, what the mean weighs: packCount(), 8 bits each

// A distance's upper 16 bits, which tell surfaces apart at any scale, and its normal.
uint packSurface(float distance_m, vec2 normal)
{
    return ((floatBitsToUint(distance_m) + 0x4000u) >> 15) | (packSnorm4x8(vec4(0.0, 0.0, normal)) & 0xFFFF0000u);
}
float distanceOf(uint packed)
{
    return uintBitsToFloat((packed & 0xFFFFu) << 15);
}
vec3 normalOf(uint packed)
{
    return octahedralDecode(unpackSnorm4x8(packed).zw);
}

uint packCounts(vec4 counts)
{
    uvec4 c = uvec4(packCount(counts.x), packCount(counts.y), packCount(counts.z), packCount(counts.w));
    return c.x | (c.y << 8) | (c.z << 16) | (c.w << 24);
}
vec4 countsOf(uint packed)
{
    vec4 c = vec4((uvec4(packed) >> uvec4(0, 8, 16, 24)) & 255u);
    return vec4(unpackCount(c.x), unpackCount(c.y), unpackCount(c.z), unpackCount(c.w));
}

// The result of earlier frames for a point.
struct Known {
    vec4 mean;
    vec4 counts;
};

// This frame's visibilities, and what each weighs.
struct Seen {
    vec4 visibility;
    vec4 weights;
};

Seen seenAt(ivec3 at)
{
    vec4 seen = texelFetch(visibility_now, at, 0);
    vec4 power = layers[layer].power;
    vec2 x = unpackSeen(seen.x, power.x);
    vec2 y = unpackSeen(seen.y, power.y);
    vec2 z = unpackSeen(seen.z, power.z);
    vec2 w = unpackSeen(seen.w, power.w);
    return Seen(vec4(x.x, y.x, z.x, w.x), vec4(x.y, y.y, z.y, w.y));
}

// Uniforms of the pass, read once [drivers: uniforms].
vec2 size_px;
bool has_normals;

struct Gathered {
    vec4 sum;
    vec4 counts;
    float shares;
    vec4 least; // least of the pixels' means
    vec4 most;
};

void gather(ivec3 at, float share, float expected_m, vec3 normal, inout Gathered found)
{
    if (any(lessThan(at.xy, ivec2(0))) || any(greaterThanEqual(vec2(at.xy), size_px))) {
        return;
    }
    uvec2 packed = texelFetch(surface_before, at, 0).xy;
    bool same = isSameSurface(distanceOf(packed.x), expected_m);
    if (same && (!has_normals || dot(normalOf(packed.x), normal) >= kSameFacing)) {
        vec4 mean_there = texelFetch(mean_before, at, 0);
        found.sum += share * mean_there;
        found.least = min(found.least, mean_there);
        found.most = max(found.most, mean_there);
        found.counts += share * countsOf(packed.y);
        found.shares += share;
    }
}

// A bicubic read between the four pixels from `first` on, all of one surface, and no further than these go. A bilinear
// one in each frame would blur the mean without end.
vec4 cubicMean(ivec3 first, vec2 part, Gathered found)
{
    // A loop, not a branch [drivers: both-sides].
    int pixels = any(greaterThan(found.most - found.least, vec4(0.004))) ? 16 : 0;
    if (pixels == 0) {
        return found.sum;
    }
    vec4 x = cubicWeights(part.x);
    vec4 y = cubicWeights(part.y);
    vec4 sum = vec4(0.0);
    ivec2 last = ivec2(size_px) - 1;
    for (int i = 0; i < pixels; ++i) {
        ivec2 pixel = clamp(first.xy + ivec2(i & 3, i >> 2) - 1, ivec2(0), last);
        sum += x[i & 3] * y[i >> 2] * texelFetch(mean_before, ivec3(pixel, first.z), 0);
    }
    return clamp(sum, found.least, found.most);
}

// The result of earlier frames at p, relative to the eye: a read between those pixels that showed the same surface.
// `now`: this frame's visibilities. Those that are of all of the light tell, too, how far pixels are apart.
Known knownOf(vec3 p, vec3 normal, vec4 now)
{
    Known none = Known(vec4(1.0), vec4(0.0));
    vec4 point = vec4(p, 1.0);
    float w = dot(layers[layer].before_w, point);
    if (!(w > 0.0)) {
        return none;
    }
    vec2 texel = vec2(dot(layers[layer].before_x, point), dot(layers[layer].before_y, point)) / w - 0.5;
    texel = clamp(texel, vec2(-2.0), size_px + 1.0); // a point far off the screen need not be representable as an
                                                     // integer
    vec2 cell = floor(texel);
    vec2 part = texel - cell;
    ivec3 first = ivec3(ivec2(cell), layer);
    float expected_m = length(p + layers[layer].before_eye.xyz);
    vec4 least = layers[layer].least;
    bvec4 is_whole = equal(least, vec4(kLeastOfWholeLight));
    Gathered found = Gathered(vec4(0.0), vec4(0.0), 0.0, mix(vec4(1.0), now, is_whole), mix(vec4(0.0), now, is_whole));
    gather(first, (1.0 - part.x) * (1.0 - part.y), expected_m, normal, found);
    gather(first + ivec3(1, 0, 0), part.x * (1.0 - part.y), expected_m, normal, found);
    gather(first + ivec3(0, 1, 0), (1.0 - part.x) * part.y, expected_m, normal, found);
    gather(first + ivec3(1, 1, 0), part.x * part.y, expected_m, normal, found);
    if (found.shares <= 0.05) { // a sliver of the surface says nothing of this pixel
        return none;
    }
    vec4 known = found.shares > 0.999 ? cubicMean(first, part, found) : found.sum / found.shares;
    vec4 counts = found.counts / found.shares;
    if (layers[layer].state.y == 0u) {
        vec4 spread = max(found.most - found.least, vec4(0.0));
        counts = min(counts, vec4(mostInMotion(spread.x, least.x), mostInMotion(spread.y, least.y),
                                  mostInMotion(spread.z, least.z), mostInMotion(spread.w, least.w)));
    }
    return Known(known, counts);
}

// The lights whose shadow on p something that moved may have changed: 0, others 1.
vec4 unmoved(vec3 p)
{
    vec4 kept = vec4(1.0);
    for (uint i = 0u; i < layers[layer].state.x; ++i) {
        vec3 centre = layers[layer].box[2u * i].xyz;
        vec3 extent = layers[layer].box[2u * i + 1u].xyz;
        for (int light = 0; light < kLightsPerLayer; ++light) {
            if (mayShadow(centre, extent, p, layers[layer].place[light], layers[layer].size[light], layers[layer].pad[light])) {
                kept[light] = 0.0;
            }
        }
    }
    return kept;
}

vec4 joined(vec4 before, vec4 counts, Seen now)
{
    vec4 v = now.visibility;
    vec4 w = now.weights;
    vec4 all = vec4(joinedMean(before.x, counts.x, v.x, w.x), joinedMean(before.y, counts.y, v.y, w.y),
                    joinedMean(before.z, counts.z, v.z, w.z), joinedMean(before.w, counts.w, v.w, w.w));
    return mix(v, all, notEqual(counts, vec4(0.0)));
}

// Joins the pixel with itself. Where this frame looks past a surface's edge it says nothing of it.
void joinAtRest(ivec3 at, Seen now, bool sees)
{
    uvec2 before = texelFetch(surface_before, at, 0).xy;
    vec4 mean_there = texelFetch(mean_before, at, 0);
    vec4 counts = min(countsOf(before.y), layers[layer].most);
    mean = sees ? joined(mean_there, counts, now) : mix(now.visibility, mean_there, notEqual(counts, vec4(0.0)));
    visibility = mean;
    surface = uvec2(before.x, sees ? packCounts(counts + now.weights) : before.y);
}

void main()
{
    ivec3 at = ivec3(ivec2(gl_FragCoord.xy), layer);
    Seen now = seenAt(at);
    float depth = texelFetch(depths, at.xy, 0).r;
    bool sees = depth != gnomon.screen.fade.z;
    if (kAtRest) {
        joinAtRest(at, now, sees);
        return;
    }
    visibility = now.visibility;
    mean = visibility;
    surface = uvec2(0u); // none
    if (!sees) {
        return;
    }
    size_px = gnomon.screen.size.xy;
    has_normals = layers[layer].state.w != 0u;
    vec4 ndc = vec4((vec2(at.xy) + 0.5) * gnomon.screen.size.zw * 2.0 - 1.0, depth, 1.0);
    vec4 h = vec4(dot(gnomon.screen.eye_x, ndc), dot(gnomon.screen.eye_y, ndc), dot(gnomon.screen.eye_z, ndc), dot(gnomon.screen.eye_w, ndc));
    vec3 p = h.xyz / h.w;
    vec2 packed_normal = texelFetch(normals, at.xy, 0).rg;
    if (layers[layer].state.y == 0u) {
        now.weights = vec4(1.0); // the few frames that count in motion all do
    }
    vec4 counts = layers[layer].most;
    Known known = Known(vec4(1.0), vec4(0.0));
    if (counts != vec4(0.0)) {
        known = knownOf(p, octahedralDecode(packed_normal), now.visibility);
    }
    counts = min(known.counts, counts) * unmoved(p);
    mean = joined(known.mean, counts, now);
    visibility = mean;
    surface = uvec2(packSurface(length(p), packed_normal), packCounts(counts + now.weights));
}
