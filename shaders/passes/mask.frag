#version 460
// SPDX-License-Identifier: Apache-2.0
// The mask. Up to four lights of one layer of the mask, for the pixel's surface; of a compact mask the lights of the
// pixel's tile that have channels in the layer. Made for one filter or a few (compiled_filters.glsl), and in software for
// one view that serves all of its map, or one of each position of the sun (GNOMON_ONE_VIEW).
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/compiled_filters.glsl"
#include "gnomon/lib/mask_numbers.glsl"
#include "gnomon/shared/gpu_structs.h"
#include "gnomon/shared/screen_blur.h"
#include "gnomon/shared/smooth_surface.h"

// Constants, and not read from buffers [drivers: both-sides].
#include "gnomon/technique_constants.glsl" // 0 to 8
layout(constant_id = 9) const bool kHasNormals = true; // else they come from depth
#ifdef GNOMON_ONE_VIEW
#undef GNOMON_FEW_VIEWS
#define GNOMON_FEW_VIEWS 1u
const bool kInSoftware = true;
#else
layout(constant_id = 10) const bool kInSoftware = false; // see mask_numbers.glsl and screen_surface.glsl
#endif
layout(constant_id = 11) const bool kHasSmooth = false; // smooth_surfaces is no stand-in
layout(constant_id = 12) const bool kTints = false; // some view has a map of tints
layout(constant_id = 13) const bool kRaysAsMask = false; // see lib/raymarch.glsl
layout(constant_id = 14) const bool kConfidence = false; // for converge.frag: packSeen()
layout(constant_id = 15) const bool kColoured = false; // all four channels are of one light: red, green, blue, luminance
#ifdef GNOMON_ONE_VIEW
const uint kTileChannels = 0;
const bool kTakesAway = false;
#else
layout(constant_id = 16) const uint kTileChannels = 0; // channels of a compact mask: 4 or 8; 0: the mask is not compact
layout(constant_id = 17) const bool kTakesAway = false; // for a compact mask with several draws: this one's is taken
                                                        // from 1
#endif
#if defined(GNOMON_ONE_VIEW) || !GNOMON_COMPILES_KERNELS
#define GNOMON_PARABOLOID false
#else
layout(constant_id = 18) const bool kParaboloid = false; // views may be paraboloids
#define GNOMON_PARABOLOID (kParaboloid && !kOrthographic)
#endif
layout(constant_id = 19) const bool kHasIds = false;   // else object_ids is a stand-in
#ifndef GNOMON_ONE_VIEW
layout(constant_id = 20) const bool kSlicesAlone = false; // see light_visibility.glsl
#define GNOMON_SLICES_ALONE kSlicesAlone
#elif GNOMON_COMPILES_KERNELS // for other filters it would add bytes and gain little
#define GNOMON_PAIRS
layout(constant_id = 21) const bool kPaired = false; // two positions of the sun
#define GNOMON_PAIRED kPaired
#endif
#ifdef GNOMON_ONE_VIEW // which leaves nothing to others
#define GNOMON_LAYERED false
#else
layout(constant_id = 23) const bool kLayered = false; // views may be ViewServes::layered ones
layout(constant_id = 24) const bool kOrthographic = false; // all views are orthographic
#define GNOMON_LAYERED (kLayered && !kOrthographic)
#define GNOMON_ORTHOGRAPHIC_ONLY kOrthographic
#endif
#if GNOMON_COMPILES_BLOCKS
layout(constant_id = 25) const bool kSettles = false; // draws what blocks settle, and leaves the rest to a draw without it
#define GNOMON_SETTLES kSettles
#endif
#if !defined(GNOMON_ONE_VIEW) && GNOMON_COMPILES_DEPTHS
layout(constant_id = 26) const bool kPages = false; // a point's view is found by a table, which is in place of tiles
#define GNOMON_PAGES (kPages && kTileChannels == 0u)
#endif
layout(constant_id = 22) const int kPixelsPerTexel = 1; // along x and y, of what is drawn to: mask-size=half
layout(push_constant) uniform Lights
{
    uint first_light; // the first light of the layer; with a compact mask the layer
    uint channels;    // bit i: this draw writes channel i; with a compact mask the draw's options
};
layout(location = 0) flat in vec4 numbers_in[kMaskNumbers];
GpuConstants numbers;
#define GNOMON_NUMBERS numbers
#define GNOMON_FEW_PLACE (kInSoftware ? numbers_in[kLightPlace] : gnomon_lights[0].place)
#define GNOMON_FEW_BINDING 8
#define GNOMON_IN_SOFTWARE kInSoftware
#define GNOMON_NEAREST_MAPS kInSoftware // filterable maps have a linear sampler, and no mapTexel() reads them
#ifdef GNOMON_ONE_VIEW
GpuView one_view;
#define GNOMON_FEW_LIGHT first_light // the light of the draw's strip
#ifdef GNOMON_PAIRS
GpuView later_view; // the view of the later position
#define GNOMON_ONE_VIEW_OF(I) (!kPaired || (I) == 0u ? one_view : later_view)
#define GNOMON_ONE_VIEW_STEPS numbers_in[kStepsPlace]
#else
#define GNOMON_ONE_VIEW_OF(I) one_view
#endif
#endif
#define GNOMON_BLOCKS_BINDING 9
#define GNOMON_TINTS kTints
#define GNOMON_TINTS_BINDING 11
#define GNOMON_SMOOTHIES (GNOMON_DEPTH_HOLDING == kDepthSmoothies)
#define GNOMON_SHOWS_RAYS kRaysAsMask
#define GNOMON_SMOOTH kHasSmooth
#define GNOMON_CONFIDENCE kConfidence
#if GNOMON_COMPILES_IDS
uint receiver_object;
uint receiver_piece;
#define GNOMON_OBJECT receiver_object
#define GNOMON_PIECE receiver_piece
#define GNOMON_OBJECTS_BINDING 4 // in place of layers of depth, which ids have none of
#endif
#define GNOMON_TILES_BINDING 12
#include "gnomon/compact_mask.glsl"
#define GNOMON_PAGE_WORDS gnomon_mask_tiles
#include "gnomon/lib/light_visibility.glsl"

layout(set = 0, binding = 5) uniform sampler2D depths;
layout(set = 0, binding = 6) uniform sampler2D normals;
layout(set = 0, binding = 10) uniform sampler2D smooth_surfaces;
layout(set = 0, binding = 7) uniform usampler2D object_ids;
layout(location = 0) out vec4 visibility;

// The lights of a draw that are left to be looked at: bits of channels, or words of a tile.
struct Left {
    uint channels;
    uint next;
    uint end;
};

// The lights to draw. For a compact mask, those of the pixel's tile that have channels in this layer.
Left lightsOf(ivec2 pixel)
{
    Left left = Left(GNOMON_FEW_VIEWS > 0 ? 1u : channels, 0u, 0u);
    if (kTileChannels > 0u) {
        GnomonTileLights tile = gnomonTileLights(pixel);
        left.next = tile.first + min(4u * first_light, tile.masked);
        left.end = tile.first + (first_light + 1u < kTileChannels / 4u ? min(4u * first_light + 4u, tile.masked) : tile.masked);
    }
    return left;
}

bool isLeft(Left left)
{
    if (GNOMON_FEW_VIEWS > 0) {
        return false; // its one light has been looked at
    }
    return kTileChannels > 0u ? left.next < left.end : left.channels != 0u;
}

// The next one. A loop passes over those that other draws have, so that their maps are not read.
GnomonTileLight nextLight(inout Left left)
{
    GnomonTileLight one = GnomonTileLight(0u, 0u, 0.0);
    if (kTileChannels > 0u) {
        bool is_own = true;
        do {
            one = gnomonTileLight(left.next);
            is_own = !kTakesAway || gnomon_lights[one.light].options.x == channels;
            ++left.next;
        } while (!is_own && left.next < left.end);
        one.weight = is_own ? one.weight : 0.0;
    } else {
        one.channel = uint(findLSB(left.channels));
        one.light = (GNOMON_FEW_VIEWS > 0 ? 0u : first_light) + one.channel;
        left.channels &= kColoured ? 0u : left.channels - 1u;
    }
    return one;
}

#define GNOMON_SURFACE_SCREEN numbers.screen
#define GNOMON_SURFACE_SAMPLED kInSoftware
#include "gnomon/lib/screen_surface.glsl"

void main()
{
#define READ(PLACE, MEMBER) numbers.MEMBER = kInSoftware ? numbers_in[PLACE] : gnomon.MEMBER;
    GNOMON_MASK_NUMBERS(READ)
#ifdef GNOMON_ONE_VIEW
#define READ_VIEW(PLACE, MEMBER) one_view.MEMBER = numbers_in[PLACE];
    GNOMON_VIEW_NUMBERS(READ_VIEW)
#ifdef GNOMON_PAIRS
#define READ_LATER(PLACE, MEMBER) later_view.MEMBER = numbers_in[PLACE + kLaterNumbers];
    GNOMON_VIEW_NUMBERS(READ_LATER)
    later_view.w = vec4(0.0, 0.0, 0.0, 1.0);
#endif
#endif
    visibility = vec4(1.0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 centre = gl_FragCoord.xy;
    if (kPixelsPerTexel > 1) { // the pixel that a texel stands for, as it is in itself
        pixel = ivec2(pixelOfTexel(pixel.x, kPixelsPerTexel), pixelOfTexel(pixel.y, kPixelsPerTexel));
        pixel = min(pixel, ivec2(numbers.screen.size.xy) - 1);
        centre = vec2(pixel) + 0.5;
    }
    float depth = GNOMON_SCREEN_TEXEL(depths, pixel).r;
    // Undrawn pixels stay lit [drivers: undrawn].
    if (depth == numbers.screen.fade.z) {
        discard;
    }
    if (kHasIds && GNOMON_SCREEN_TEXEL(object_ids, pixel).r == 0) {
        discard;
    }
#ifdef GNOMON_OBJECT
    uint number = GNOMON_SCREEN_TEXEL(object_ids, pixel).r;
    receiver_object = (number & ((1u << kPieceShift) - 1u)) - 1u;
    receiver_piece = number >> kPieceShift;
#endif
    Left left = lightsOf(pixel);
    if (kTileChannels > 0u && !isLeft(left)) {
        discard;
    }
    vec4 h = pointAt(pixel, depth);
    vec3 p = h.xyz / h.w;
    vec3 n = kHasNormals ? octahedralDecode(GNOMON_SCREEN_TEXEL(normals, pixel).rg) : normalFromDepth(pixel, depth, p);
    SmoothSurface s = kHasSmooth ? smoothDecode(GNOMON_SCREEN_TEXEL(smooth_surfaces, pixel).rgb, p, n) : flatSurface(n);
    do {
        GnomonTileLight one = nextLight(left);
        vec4 v = lightVisibility(one.light, p, n, s, vec3(1.0), centre, h.w);
#ifdef GNOMON_MAY_LEAVE
        if (kSettles && lookup_left && (kTileChannels == 0u || one.weight > 0.0)) {
            discard;
        }
#endif
        if (kConfidence && lookup_confidence >= 0.0) {
            v += packSeen(0.0, lookup_confidence);
        }
        bvec4 channel = equal(uvec4(one.channel & 3u), uvec4(0, 1, 2, 3));
        vec4 beside = kTileChannels > 0u ? visibility - one.weight * (1.0 - v.a) : vec4(v.a);
        visibility = kColoured ? v : mix(visibility, beside, channel);
    } while (isLeft(left));
    if (kTakesAway) {
        visibility = 1.0 - visibility;
    }
}
