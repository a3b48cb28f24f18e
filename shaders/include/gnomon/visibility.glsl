// SPDX-License-Identifier: Apache-2.0
// GLSL only: how much of a light reaches a point, for a host that shades from the maps itself. Every other name of the
// library that this declares begins with gnomon or GNOMON, or GN_.
//
// Define beforehand, if the defaults do not suit:
//   GNOMON_SET      descriptor set of the bindings below (0)
//   GNOMON_BINDING  the first of them (0)
//   GNOMON_FILTER   GNOMON_FILTER_PCF or another macro of gnomon/shared/filter_numbers.h: the only filter that is
//                   compiled, which the options must have. Without it all are compiled, and GpuRule or the constant of
//                   technique_constants.glsl chooses
//   GNOMON_FILTERS  in its place: the bits of the filters to compile (1 << GNOMON_FILTER_PCF)
//   GNOMON_ORTHOGRAPHIC_ONLY  true, or a constant that says so: all views are orthographic (ViewProjection::orthographic), which
//                   costs less
//   GNOMON_TINTS    true, or a constant that says so: blended casters tint the light, which takes binding 6
//   GNOMON_LAYERED  true, or a constant that says so: options may have MultiDivide::receivers. Without it frustums that
//                   overlap do not fade over into each other
//   GNOMON_IN_SOFTWARE  true, or a constant that says so: a software rasteriser runs it, which is then quicker. Without it
//                   all invocations test a light's views in turn, and a GPU has a view's numbers in scalar registers
//   GNOMON_SMOOTHIES  true, or a constant that says so: options may have soften smoothies (hard and pcf) or
//                   filter smoothies, for which GNOMON_FILTER is GNOMON_FILTER_PCF
//   GNOMON_OBJECT   needed for filters id and depth-id: the index in Frame::objects of the object whose surface is
//                   shaded, as an expression (uint); takes binding 7
//   GNOMON_PIECE    beside it, for lights with IdOf::face: the piece of that object (uint), as its casters have it; else 0
// Bindings, from GNOMON_BINDING on (structures: gnomon/shared/gpu_structs.h):
//   0  uniform buffer: GpuConstants
//   1  combined image sampler, 2D array: the maps. For a filterable filter the sampler is linear within and between mip
//      levels, for others nearest (not every device filters depth); it clamps to the edge
//   2  storage buffer: GpuLight, by the light's index
//   3  storage buffer: GpuView. With Partition::sdsm the backend completes them on the GPU
//   4  storage buffer: GpuDepthLayers. Only where filter lvsm is compiled
//   5  combined image sampler, 2D array of unsigned integers: the blocks of the maps (gnomon/shared/map_blocks.h), in GENERAL,
//      sampler nearest. Filters pcss and raymarch; a shader for other filters does not have it. For hard and pcf with
//      GNOMON_SMOOTHIES it holds their smoothies (gnomon/shared/smoothies.h)
//   6  combined image sampler, 2D array: the maps of tints, sampler nearest. Only with GNOMON_TINTS
//   7  storage buffer: filled by pack::fillObjects(). Only with GNOMON_OBJECT
//   8  uniform buffer: the first kFewViews of the GpuViews. Only with technique_constants.glsl
#ifndef GNOMON_PUBLIC_VISIBILITY_GLSL
#define GNOMON_PUBLIC_VISIBILITY_GLSL
#include "names_begin.glsl"
#include "lib/light_visibility.glsl"

// The share of light `light` of the frame, 0 .. 1 for each colour, that arrives at a point of a surface. `point`:
// relative to the camera's eye, metres, in the world's axes; `normal`: the unit geometric normal there; `pixel`:
// gl_FragCoord.xy, whose rows count from the one where Camera::clip_from_world has y = -1. Returns 0 for a surface that faces away from the light, and 1 for a light without a map. Alpha is
// the luminance (ITU-R BT.709). Without GNOMON_TINTS all four are the same.
vec4 gnomonLightColour(uint light, vec3 point, vec3 normal, vec2 pixel)
{
    return lightVisibility(light, point, normal, flatSurface(normal), vec3(1.0), pixel,
                           1.0 / dot(gnomon.screen.clip_w, vec4(point, 1.0)));
}

// The share for a smooth-shaded mesh: the interpolated normal decides whether a point faces the light, so that the
// terminator has no steps. `smooth_surface`: the result of gnomonSmoothSurface() (smooth_surface.glsl) there, or
// vec4(normal, -1.0). `own_tint`: for a blended surface that casts, the tint that it draws to maps of tints, 1 - alpha
// (1 - colour), each 0 .. 1; it is in the map and must not tint itself. 1 for any other surface.
vec4 gnomonLightColour(uint light, vec3 point, vec3 normal, vec4 smooth_surface, vec3 own_tint, vec2 pixel)
{
    return lightVisibility(light, point, normal, SmoothSurface(smooth_surface.xyz, smooth_surface.w), own_tint, pixel,
                           1.0 / dot(gnomon.screen.clip_w, vec4(point, 1.0)));
}

// Visibility, 0 .. 1: the luminance of gnomonLightColour().
float gnomonLightVisibility(uint light, vec3 point, vec3 normal, vec2 pixel)
{
    return gnomonLightColour(light, point, normal, pixel).a;
}
// Visibility, 0 .. 1, on a smooth-shaded mesh.
float gnomonLightVisibility(uint light, vec3 point, vec3 normal, vec4 smooth_surface, vec2 pixel)
{
    return gnomonLightColour(light, point, normal, smooth_surface, vec3(1.0), pixel).a;
}

#include "names_end.glsl"
#endif
