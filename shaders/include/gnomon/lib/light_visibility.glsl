// SPDX-License-Identifier: Apache-2.0
// GLSL only: a light's visibility at a point, from buffers that gnomon::pack fills. The mask pass calls it, and
// include/gnomon/visibility.glsl gives it to hosts; that header lists the macros to define beforehand.
#ifndef GNOMON_LIGHT_VISIBILITY_GLSL
#define GNOMON_LIGHT_VISIBILITY_GLSL
#ifndef GNOMON_SET
#define GNOMON_SET 0
#endif
#ifndef GNOMON_BINDING
#define GNOMON_BINDING 0
#endif
#include "../shared/object_ids.h"
#include "../shared/gpu_structs.h"
#include "../shared/sun_steps.h"

layout(set = GNOMON_SET, binding = GNOMON_BINDING, std140) uniform GnomonConstants
{
    GpuConstants gnomon;
};
// A pass may define a copy of those of its members that are the same for all pixels.
#ifndef GNOMON_NUMBERS
#define GNOMON_NUMBERS gnomon
#endif
layout(set = GNOMON_SET, binding = GNOMON_BINDING + 2, std430) restrict readonly buffer GnomonLights
{
    GpuLight gnomon_lights[];
};
layout(set = GNOMON_SET, binding = GNOMON_BINDING + 3, std430) restrict readonly buffer GnomonViews
{
    GpuView gnomon_views[];
};
// A pass that knows whose surface it asks for defines GNOMON_OBJECT, the index of the object (uint), and may define
// GNOMON_OBJECTS_BINDING: pack::fillObjects(). GNOMON_PIECE: which piece of it, for lights with IdOf::face.
#ifdef GNOMON_OBJECT
#ifndef GNOMON_PIECE
#define GNOMON_PIECE 0u
#endif
#ifndef GNOMON_OBJECTS_BINDING
#define GNOMON_OBJECTS_BINDING GNOMON_BINDING + 7
#endif
layout(set = GNOMON_SET, binding = GNOMON_OBJECTS_BINDING, std430) restrict readonly buffer GnomonObjects
{
    vec4 gnomon_objects[];
};
#endif
// See below.
#ifdef GNOMON_FEW_VIEWS
#ifndef GNOMON_FEW_BINDING
#define GNOMON_FEW_BINDING GNOMON_BINDING + 8
#endif
#ifndef GNOMON_FEW_LIGHT
#define GNOMON_FEW_LIGHT 0
#endif
#ifndef GNOMON_FEW_PLACE
#define GNOMON_FEW_PLACE gnomon_lights[GNOMON_FEW_LIGHT].place
#endif
layout(set = GNOMON_SET, binding = GNOMON_FEW_BINDING, std140) uniform GnomonFewViews
{
    GpuView gnomon_few_views[kFewViews];
};
#endif

// A pass that is made for one technique has its numbers as constants.
#ifdef GNOMON_FILTER
#undef GNOMON_FILTER_NUMBER
#define GNOMON_FILTER_NUMBER GNOMON_FILTER
#elif !defined(GNOMON_FILTER_NUMBER)
#define GNOMON_FILTER_NUMBER GNOMON_NUMBERS.rule.reading.x
#endif
#ifndef GNOMON_KERNEL_WIDTH
#define GNOMON_KERNEL_WIDTH GNOMON_NUMBERS.rule.reading.y
#define GNOMON_DISC_TAPS GNOMON_NUMBERS.rule.reading.z
#define GNOMON_DEPTH_HOLDING GNOMON_NUMBERS.rule.reading.w
#define GNOMON_MOMENT_FLAGS GNOMON_NUMBERS.rule.moments.x
#define GNOMON_MOMENT_SAMPLING GNOMON_NUMBERS.rule.moments.y
#define GNOMON_MOMENT_LAYERS GNOMON_NUMBERS.rule.moments.z
#define GNOMON_AUTOMATIC_BIAS (GNOMON_NUMBERS.rule.bias.x > 0.0)
#endif
#define GNOMON_MAP_SET GNOMON_SET
#define GNOMON_MAP_BINDING GNOMON_BINDING + 1
#define GNOMON_LAYERS_BINDING GNOMON_BINDING + 4
#define GNOMON_MAP_TEXEL_SIZE GNOMON_NUMBERS.rule.disc.zw
#ifndef GNOMON_BLOCKS_BINDING
#define GNOMON_BLOCKS_BINDING GNOMON_BINDING + 5
#endif
// A pass may define GNOMON_SETTLES, a constant: it draws what blocks settle (lib/cone_texels.glsl), and leaves a pixel to
// another draw where the last lightVisibility() set lookup_left.
#ifdef GNOMON_SETTLES
#define GNOMON_MAY_LEAVE
bool lookup_left;
#endif
#include "map_texture.glsl"

// A pass may define GNOMON_IN_SOFTWARE, a constant: a software rasteriser runs it.
#ifndef GNOMON_IN_SOFTWARE
#define GNOMON_IN_SOFTWARE false
#endif
#define GNOMON_RECOMPUTES !GNOMON_IN_SOFTWARE

vec2 discPoint(int i)
{
    vec4 two = gnomon.rule.disc_points[i >> 1];
    return (i & 1) == 0 ? two.xy : two.zw;
}
// Whether few views are told apart by slices of one depth alone, which all of them count in: a constant.
#ifndef GNOMON_SLICES_ALONE
#define GNOMON_SLICES_ALONE false
#endif
#ifdef GNOMON_ONE_VIEW_OF
#define GNOMON_KNOWN_VIEW true
#elif defined(GNOMON_PAGES)
#define GNOMON_KNOWN_VIEW (GNOMON_SLICES_ALONE || GNOMON_PAGES)
#else
#define GNOMON_KNOWN_VIEW GNOMON_SLICES_ALONE
#endif
#include "visibility.glsl"
// A pass may define GNOMON_LAYERED, whether views may be ViewServes::layered ones: a constant.
#ifndef GNOMON_LAYERED
#define GNOMON_LAYERED false
#endif
// A pass may define GNOMON_TINTS, whether blended casters have maps, and GNOMON_TINTS_BINDING for those.
#ifndef GNOMON_TINTS
#define GNOMON_TINTS false
#else
#define GNOMON_HAS_TINTS
#ifndef GNOMON_TINTS_BINDING
#define GNOMON_TINTS_BINDING GNOMON_BINDING + 6
#endif
#include "tint.glsl"
#endif

// A pass may define GNOMON_CONFIDENCE, whether it wants to know how far the last lightVisibility() is to be trusted.
#ifndef GNOMON_CONFIDENCE
#define GNOMON_CONFIDENCE false
#else
#define GNOMON_HAS_CONFIDENCE
#include "../shared/converge.h"
float lookup_confidence; // less than 0: no map was asked
#endif

// Whether there may be smooth surfaces, a constant. Light that all but grazes flat ones is too little to be seen.
#ifndef GNOMON_SMOOTH
#define GNOMON_SMOOTH true
#endif
#if GNOMON_COMPILES_DEPTHS
#define GNOMON_ASKS_GRAZED // filters that compare the depths of a map
#endif

// A surface's point as filters need it.
struct Receiver {
    vec3 p; // eye-relative
    vec3 n;
    vec3 own_tint;
    PixelSteps steps;
    bool asks; // some view's map
#ifdef GNOMON_ASKS_GRAZED
    GrazedPoint grazed;
#endif
    float off_plane_m; // BiasRule
};

FilterInput filterInput(vec2 pixel)
{
    FilterInput f;
    f.layer = 0.0;
    f.part = 0.0;
    f.kernel_width = GNOMON_KERNEL_WIDTH;
    f.disc_taps = GNOMON_DISC_TAPS;
    f.disc_radius = GNOMON_NUMBERS.rule.disc.x;
    f.kernel = GNOMON_NUMBERS.rule.kernel;
    f.smoothies = 0.0;
#ifdef GNOMON_SMOOTHIES
    if (GNOMON_SMOOTHIES) {
        f.smoothies = GNOMON_NUMBERS.rule.moment_variance.w;
    }
#endif
    f.stood = gnomon.rule.moments.w;
    // So far from frame to frame, the noise of discs.h is another one everywhere: J. Jimenez, as there.
    f.pixel = pixel;
    f.shift = 5.588238 * GNOMON_NUMBERS.rule.disc.y;
    f.moments = momentsOf(GNOMON_MOMENT_FLAGS, GNOMON_MOMENT_SAMPLING, GNOMON_MOMENT_LAYERS, GNOMON_NUMBERS.rule.moment_warp,
                          GNOMON_NUMBERS.rule.moment_variance, GNOMON_NUMBERS.rule.moment_shape);
    return f;
}

#ifdef GNOMON_OBJECT
// Fills in the receiver's object for filters id and depth-id; `options`: GpuLight's. A missing object counts as the
// ground, which has id 0.
void placeObject(inout FilterInput f, uvec4 options, vec3 p)
{
    uint object = GNOMON_OBJECT < options.z ? GNOMON_OBJECT : 0u;
    f.place = p;
    f.object_centre = gnomon_objects[2u * object].xyz;
    f.object_half = gnomon_objects[2u * object + 1u].xyz;
    f.id = GNOMON_OBJECT < options.z ? gnomon_objects[options.y + (object >> 2)][object & 3u] : 0.0;
    if (options.w != 0u) {
        f.id = idOfPiece(f.id, float(GNOMON_PIECE % uint(kMostPieces)), abs(f.kernel.y));
    }
}
#endif

// A pass may define GNOMON_FEW_VIEWS: how many views its one light has, 1 to kFewViews, which are all of the plan's; 0: a
// draw for which this is not so. And GNOMON_FEW_BINDING for them, GNOMON_FEW_LIGHT, which GpuLight it is, if not the first,
// and GNOMON_FEW_PLACE, its GpuLight::place. Few views are read as uniforms, which software loads faster, and told apart by
// their slices before one of them is loaded.
// Where there is one that serves all of its map, the pass may have it already: GNOMON_ONE_VIEW_OF(i). And where there is
// one of each of two positions of a sun: GNOMON_PAIRED, a constant, and GNOMON_ONE_VIEW_STEPS for GpuLight::steps.
#ifndef GNOMON_PAIRED
#define GNOMON_PAIRED false
#endif
#ifdef GNOMON_FEW_VIEWS
GpuView viewAt(uint i)
{
#ifdef GNOMON_ONE_VIEW_OF
    return GNOMON_ONE_VIEW_OF(i);
#else
    if (GNOMON_FEW_VIEWS > 0) {
        return gnomon_few_views[i];
    }
    return gnomon_views[i];
#endif
}

float sharedDepth(vec3 p)
{
    return dotRow(gnomon_few_views[0].slice_axis, p);
}

// A bit for each view whose slice holds the point.
uint slicesAt(vec3 p)
{
    uint slices = 0u;
    float depth = GNOMON_SLICES_ALONE ? sharedDepth(p) : 0.0;
    for (uint i = 0u; i < GNOMON_FEW_VIEWS; ++i) {
        bool holds = GNOMON_SLICES_ALONE ? !(depth < gnomon_few_views[i].slice.x || depth > gnomon_few_views[i].slice.y)
                                         : inSlice(gnomon_few_views[i], p);
        slices |= holds ? 1u << i : 0u;
    }
    return slices;
}
#else
#define GNOMON_FEW_VIEWS 0
#define GNOMON_FEW_LIGHT 0
#define GNOMON_FEW_PLACE vec4(0.0)
GpuView viewAt(uint i)
{
    return gnomon_views[i];
}

float sharedDepth(vec3 p)
{
    return 0.0;
}

uint slicesAt(vec3 p)
{
    return 0u;
}
#endif

// How a point's views are looked for. In software a pixel goes from one that serves it to the next, and never asks those
// whose slice does not hold it; the filter is reached once, for the lanes of a group share each branch. Otherwise all
// pixels ask all views in turn, so that a view is the same for all of them: a GPU then has its numbers in scalar registers,
// which leaves the others to the filter, and skips the filter where no pixel of a group needs it.

// The views among which a point's are looked for.
struct Search {
    uint next;
    uint end;
    uint slices; // with few views: a bit for each that is left
    float left;  // with layered views: the share that those before leave
};

bool isLeft(Search s)
{
    return GNOMON_FEW_VIEWS != 1 && (GNOMON_FEW_VIEWS > 0 && GNOMON_IN_SOFTWARE ? s.slices != 0u : s.next < s.end);
}

// The next view, and what it counts for; 0: it does not serve the point. In software the next one that does, or 0: there is
// none. A loop tests at its end, because a device that runs the lanes of a group together runs a body once more for a test
// at its beginning.
float nextShare(inout Search s, bool is_first, Receiver r, out uint view)
{
    float share = 0.0;
    do {
        view = GNOMON_FEW_VIEWS > 1 && GNOMON_IN_SOFTWARE ? min(uint(findLSB(s.slices)), GNOMON_FEW_VIEWS - 1) : s.next;
        uint slice = GNOMON_IN_SOFTWARE ? ~0u : 1u << view;
        bool is_held = !GNOMON_SLICES_ALONE || (s.slices & slice) != 0u; // a slice in which nobody casts has no view
        s.slices &= GNOMON_IN_SOFTWARE ? s.slices - 1u : ~0u;
        ++s.next;
        GpuView asked = viewAt(view);
        share = is_first ? 1.0 : viewShare(asked, GNOMON_SLICES_ALONE ? sharedDepth(r.p) : sliceDepth(asked, r.p));
        bool is_within = viewContains(asked, r.p);
        share = is_within && is_held && r.asks ? share : 0.0;
        if (GNOMON_LAYERED && isLayered(asked)) {
            float counts = is_within && is_held && r.asks ? min(s.left, viewOpacity(asked, r.p)) : 0.0;
            s.left -= counts;
            share = counts > 0.0 ? counts / (1.0 - s.left) : 0.0; // share in a mean over those so far
        }
    } while (GNOMON_IN_SOFTWARE && share == 0.0 && isLeft(s));
    return share;
}

// Visibility by the views [first, end) of one position of a light, which are in the order in which they fade over into
// each other. Here as in what follows, a: the visibility, in which blended casters count by their luminance; rgb: the
// same for each colour, which without GNOMON_TINTS is never looked at on the way.
vec4 viewsVisibility(uint first, uint end, FilterInput f, Receiver r)
{
    float seen = 1.0;
    vec3 colour = vec3(seen);
    uint view = first;
    Search s = Search(first, end, slicesAt(r.p), 1.0);
    bool is_first = true;
    float share = nextShare(s, true, r, view);
    // Nearly every pixel is in a single view: in software none branches, and pixels outside discard their result.
    // It must not depend on uniforms at fixed places alone [drivers: fixed-place].
    const bool is_alone = GNOMON_FEW_VIEWS == 1 && GNOMON_IN_SOFTWARE;
    bool more = false;
    if (is_alone || share > 0.0 || !GNOMON_IN_SOFTWARE) {
        do {
            if (GNOMON_IN_SOFTWARE || share > 0.0) {
                GpuView read = viewAt(view);
                BiasRule bias = biasOf(GNOMON_NUMBERS.rule.bias, GNOMON_NUMBERS.rule.bias_more, r.off_plane_m);
                bias.automatic = GNOMON_AUTOMATIC_BIAS ? 1.0 : 0.0;
                MapRows rows = rowsAt(read, r.p);
                MapPoint point = projectReceiver(rows, bias, r.p, r.n);
                float here = viewVisibility(GNOMON_FILTER_NUMBER, read, rows, point, f, r.steps, r.p, r.n);
#ifdef GNOMON_MAY_LEAVE
                lookup_left = lookup_left || (here < 0.0 && share > 0.0);
                here = max(here, 0.0); // the pixel may be decided by other means
#endif
#ifdef GNOMON_ASKS_GRAZED
                if (GNOMON_SMOOTH && GNOMON_COMPARES_DEPTHS(GNOMON_FILTER_NUMBER) && GNOMON_AUTOMATIC_BIAS && r.grazed.sine > 0.0) {
                    here = min(here, grazedVisibility(read, rows, point.texel_depth, bias, f, r.grazed.p, r.grazed.sine));
                }
#endif
#ifdef GNOMON_HAS_TINTS
                if (GNOMON_TINTS) {
                    vec4 tint = viewTint(read, point, r.own_tint);
                    vec3 tinted = here * tint.rgb;
                    here *= tint.a;
                    colour = GNOMON_FEW_VIEWS == 1 ? (share > 0.0 ? tinted : colour) : colour * (1.0 - share) + tinted * share;
                }
#endif
                // The first view's value is taken exactly, which mix() does not promise.
                seen = GNOMON_FEW_VIEWS == 1 ? (share > 0.0 ? here : seen) : seen * (1.0 - share) + here * share;
#ifdef GNOMON_HAS_CONFIDENCE
                if (GNOMON_CONFIDENCE) {
                    float confidence = texelConfidence(point.texel);
                    lookup_confidence = lookup_confidence * (1.0 - share) + confidence * share;
                }
#endif
                is_first = false;
            }
            share = 0.0;
            more = isLeft(s);
            if (more) {
                share = nextShare(s, is_first, r, view);
            }
        } while (GNOMON_IN_SOFTWARE ? share > 0.0 : more);
    }
    return GNOMON_TINTS ? vec4(colour, seen) : vec4(seen);
}

// A pass may define GNOMON_PAGES, whether its lights have pages, a constant, and GNOMON_PAGE_WORDS, the words of
// pack::fillPageTable(). Without it each page is asked in turn.
#ifdef GNOMON_PAGES
// The finest page around a point: down from the root of the light's face that the point is in, to where nothing is finer.
// `toward`: from the point to a light with a place. Of a light with one root all faces are that. Nothing branches but the
// walk, which keeps the module small.
uint pageAt(GpuLight light, vec4 p, vec3 toward)
{
    vec3 far = abs(toward);
    uint axis = mix(mix(2u, 1u, far.y >= far.z), 0u, far.x >= max(far.y, far.z));
    uvec2 root = GNOMON_PAGE_WORDS[light.options.y + 2u * axis + mix(0u, 1u, toward[axis] > 0.0)];
    GpuView view = gnomon_views[root.y];
    vec2 at = vec2(dot(view.sector_x, p), dot(view.sector_y, p)) / dot(view.sector_w, p) + 1.0;
    uint node = root.x;
    uint word = 0x10000u;
    while (word > 0xFFFFu) { // tested before [drivers: loop-result]
        vec2 high = step(vec2(1.0), at);
        at -= high;
        at += at;
        uvec2 quarter = uvec2(high);
        node += word >> 16;
        word = GNOMON_PAGE_WORDS[node + quarter.y][quarter.x];
    }
    return light.views.x + word;
}
#endif

// `p` eye-relative, `n` its unit geometric normal, `s` the smooth surface over it; `own_tint` of a blended caster, else
// 1; `pixel` of the screen; `w` of the point by GpuScreen's eye_w: one over clip space's w.
vec4 lightVisibility(uint index, vec3 p, vec3 n, SmoothSurface s, vec3 own_tint, vec2 pixel, float w)
{
#ifdef GNOMON_HAS_CONFIDENCE
    lookup_confidence = -1.0;
#endif
    GpuLight light;
    if (GNOMON_FEW_VIEWS > 0) {
        light.place = GNOMON_FEW_PLACE;
        light.size = gnomon_lights[GNOMON_FEW_LIGHT].size;
        light.options = gnomon_lights[GNOMON_FEW_LIGHT].options;
        light.views = uvec4(0u, GNOMON_FEW_VIEWS, 1u, GNOMON_PAIRED ? 1u : 0u);
#ifdef GNOMON_ONE_VIEW_STEPS
        light.steps = GNOMON_ONE_VIEW_STEPS;
#endif
    } else {
        light = gnomon_lights[index];
    }
    if (light.views.y == 0u) {
        return vec4(1.0);
    }
    vec3 toward = towardLight(light.place, p);
    LightPoint at = lightPoint(p, n, s, toward, lightSpread(light.place, toward, light.size.x));
    Receiver r;
    r.p = at.p;
    r.n = at.n;
    r.own_tint = own_tint;
    r.asks = at.share > 0.0 || GNOMON_IN_SOFTWARE || GNOMON_CONFIDENCE;
    r.steps = pixelSteps(GNOMON_NUMBERS.screen.eye_x, GNOMON_NUMBERS.screen.eye_y, GNOMON_NUMBERS.screen.eye_z, GNOMON_NUMBERS.screen.eye_w, w,
                         2.0 * GNOMON_NUMBERS.screen.size.zw);
    r.off_plane_m = offPlane(GNOMON_NUMBERS.screen.eye_x, GNOMON_NUMBERS.screen.eye_y, GNOMON_NUMBERS.screen.eye_z, GNOMON_NUMBERS.screen.eye_w, w,
                             2.0 * GNOMON_NUMBERS.screen.size.zw, p, n, GNOMON_NUMBERS.rule.bias.z, GNOMON_NUMBERS.rule.bias_more.x);
    FilterInput f = filterInput(pixel);
    f.toward = towardLight(light.place, at.p);
    f.spread = lightSpread(light.place, f.toward, light.size.x);
#ifdef GNOMON_ASKS_GRAZED
    r.grazed = grazedPoint(at, p, n, f.toward, f.spread / length(f.toward));
#endif
#ifdef GNOMON_OBJECT
    placeObject(f, light.options, at.p);
    f.lifted = at.p == p ? 0.0 : 1.0;
#endif
#ifdef GNOMON_MAY_LEAVE
    lookup_left = false;
#endif
    float faded = fadedShare(GNOMON_NUMBERS.screen.fade, length(p));
    float seen = 1.0;
    vec3 colour = vec3(1.0);
    uvec2 range = light.views.xy;
#ifdef GNOMON_PAGES
    if (GNOMON_PAGES) {
        range = uvec2(pageAt(light, vec4(r.p, 1.0), f.toward), 1u);
    }
#endif
    bool is_later = false;
    bool more = light.views.w > 0u;
    do { // over the positions of the sun, so that the filter is compiled once
        vec4 here = mix(viewsVisibility(range.x, range.x + range.y, f, r), vec4(1.0), faded);
        here = min(here, vec4(at.share)); // filters with rays to the disc know its horizon already
        float weight = stepWeight(light.steps, pixel.x * GNOMON_NUMBERS.screen.size.z);
        seen = is_later ? steppedVisibility(seen, here.a, weight) : here.a;
        if (GNOMON_TINTS) {
            colour = is_later ? steppedVisibility(vec4(colour, 1.0), here, weight).rgb : here.rgb;
        }
        more = more && !is_later;
        range = light.views.zw;
        is_later = true;
    } while ((GNOMON_FEW_VIEWS == 0 || GNOMON_PAIRED) && more); // else few views are of one position
#ifdef GNOMON_MAY_LEAVE
    lookup_left = lookup_left && at.share > 0.0 && faded < 1.0;
#endif
    return GNOMON_TINTS ? vec4(colour, seen) : vec4(seen);
}

#endif
