#version 460
// SPDX-License-Identifier: Apache-2.0
// Draws casters into a map. An instance brings the rows that take its own points to the map, multiplied
// out on the CPU in double precision: three of them when the map is orthographic (its z is the metric), else five.
// CLIPPED: what lies outside two planes in the object's own space is not drawn.
// LAYERED: several views are drawn in one pass, and an instance says to which of their layers it belongs; PLACED: the GPU
// has fitted them to parts of their base maps.
// Inputs that a pipeline does not use are others' (vertexInput() in caster_pipelines.cpp), and nobody reads them.
#extension GL_GOOGLE_include_directive : require
#ifdef LAYERED
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#include "gnomon/lib/caster.glsl"

// CasterConstants.
layout(constant_id = 2) const bool kColoured = false; // vertices have colours
layout(constant_id = 3) const bool kMasked = false;   // the caster has a texture
layout(constant_id = 4) const bool kPerspective = false; // the map is not orthographic
layout(constant_id = 5) const bool kMetric = false; // a fragment shader stores it
layout(constant_id = 6) const bool kIds = false;    // the map holds ids of objects
layout(constant_id = 7) const bool kParaboloid = false; // the map is one: caster.glsl
#ifndef LAYERED
layout(constant_id = 8) const bool kPlaced = false; // as PLACED
#endif

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 row_x;
layout(location = 2) in vec4 row_y;
layout(location = 3) in vec4 row_z;
layout(location = 4) in vec4 row_w;
layout(location = 5) in vec4 row_metric;
layout(location = 6) in vec2 uv_in;
#ifdef LAYERED
layout(location = 7) in uint layer; // counted from the first view's
#else
layout(location = 7) in vec4 place; // the same for all
#endif
#ifdef PLACED
#include "gnomon/shared/gpu_cascades.h"
layout(set = 1, binding = 0, std430) readonly buffer Places
{
    GpuFittedView fitted[]; // by view of the plan
};
#endif
layout(location = 8) in vec4 row_own; // takes the object's own points to the depth beside its id
layout(location = 9) in vec2 id_in; // x: as it is stored, of the object's first piece; y: how many ids there are
layout(location = 10) in uint piece; // its lower bits count
layout(location = 11) in vec4 colour_in; // linear
layout(location = 0) out float metric;
layout(location = 1) out vec2 uv;
layout(location = 2) out vec3 rim; // for a paraboloid
layout(location = 3) out float own;
layout(location = 4) flat out float id;
layout(location = 5) out vec4 colour;
layout(location = 6) out vec4 ray; // for a paraboloid. xyz: from the light, w: minus the near distance, both in lengths of far - near
layout(push_constant) uniform Material
{
    vec4 uv_u; // rows of the texture's transform: u = dot(uv_u.xyz, (uv, 1))
    vec4 uv_v;
    float cutoff;
    int first_view; // the first of the views that are drawn in one pass
#ifdef CLIPPED
    vec4 tint; // caster_tint.frag's
    vec4 clip_planes[2];
#endif
};
#ifdef CLIPPED
out float gl_ClipDistance[2];
#endif

vec4 placed(vec4 clip)
{
#ifdef PLACED
    return casterPlaced(clip, fitted[first_view + int(layer)].place);
#elif defined(LAYERED)
    return clip;
#else
    return kPlaced ? casterPlaced(clip, place) : clip;
#endif
}

void main()
{
    vec4 p = vec4(position, 1.0);
    precise vec4 clip; // a map is the same bit for bit whichever of these pipelines draws it
    clip = vec4(dot(row_x, p), dot(row_y, p), dot(row_z, p), 1.0);
    if (kPerspective) {
        clip.w = dot(row_w, p);
    }
    if (kParaboloid) {
        ray = vec4(clip.xyz, dot(row_metric, p));
        rim = casterRim(clip);
    } else if (kMetric) {
        metric = kPerspective ? dot(row_metric, p) : clip.z;
    }
    if (kIds) {
        own = dot(row_own, p);
        id = casterPieceId(id_in.x, float(piece & uint(kMostPieces - 1)), id_in.y);
    }
#ifdef CLIPPED
    gl_ClipDistance[0] = casterInside(position, clip_planes[0]);
    gl_ClipDistance[1] = casterInside(position, clip_planes[1]);
#endif
#ifdef LAYERED
    gl_Layer = int(layer);
#endif
    gl_Position = kParaboloid ? casterParaboloid(clip) : placed(clip);
    if (kMasked) {
        vec3 t = vec3(uv_in, 1.0);
        uv = vec2(dot(uv_u.xyz, t), dot(uv_v.xyz, t));
        colour = kColoured ? colour_in : vec4(1.0);
    }
}
