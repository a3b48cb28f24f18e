#version 460
// SPDX-License-Identifier: Apache-2.0
// Draws casters into a map. An instance brings the rows that take its own points to the map, multiplied
// out on the CPU in double precision: three of them when the map is orthographic (its z is the metric), else five.
// CLIPPED: what lies outside two planes in the object's own space is not drawn. PARABOLOID: the map is one (caster.glsl).
// IDS: the map holds ids of objects.
// LAYERED: several views are drawn in one pass, and an instance says to which of their layers it belongs.
#extension GL_GOOGLE_include_directive : require
#ifdef LAYERED
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#include "gnomon/lib/caster.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 row_x;
layout(location = 2) in vec4 row_y;
layout(location = 3) in vec4 row_z;
#ifdef PERSPECTIVE
layout(location = 4) in vec4 row_w;
layout(location = 5) in vec4 row_metric;
#define UV_LOCATION 6
#else
#define UV_LOCATION 4
#endif
#ifdef LAYERED
layout(location = 7) in uint layer; // counted from the first view's
#ifdef PLACED
#include "gnomon/shared/gpu_cascades.h"
layout(set = 1, binding = 0, std430) readonly buffer Places
{
    GpuFittedView fitted[]; // by view of the plan
};
#endif
#elif defined(PLACED)
layout(location = 7) in vec4 place; // the same for all
#endif
#ifdef IDS
layout(location = 8) in vec4 row_own; // takes the object's own points to the depth beside its id
layout(location = 9) in vec2 id_in; // x: as it is stored, of the object's first piece; y: how many ids there are
layout(location = 10) in uint piece; // its lower bits count
layout(location = 3) out float own;
layout(location = 4) flat out float id;
#endif
#ifdef PARABOLOID
layout(location = 0) out vec4 ray; // xyz: from the light, w: minus the near distance, both in lengths of far - near
layout(location = 2) out vec3 rim;
#elif defined(METRIC)
layout(location = 0) out float metric; // for fragment shaders that store it
#endif
#ifdef MASKED
layout(location = UV_LOCATION) in vec2 uv_in;
layout(location = 1) out vec2 uv;
layout(constant_id = 2) const bool kColoured = false;
layout(location = 11) in vec4 colour_in; // linear; where not kColoured some other attribute, which nobody reads
layout(location = 5) out vec4 colour;
#endif
#if defined(MASKED) || defined(CLIPPED) || (defined(LAYERED) && defined(PLACED))
layout(push_constant) uniform Material
{
    vec4 uv_u; // rows of the texture's transform: u = dot(uv_u.xyz, (uv, 1))
    vec4 uv_v;
    float cutoff;
    int first_view; // of those that are drawn in one pass
#ifdef CLIPPED
    layout(offset = 64) vec4 clip_planes[2];
#endif
};
#endif
#ifdef CLIPPED
out float gl_ClipDistance[2];
#endif

void main()
{
    vec4 p = vec4(position, 1.0);
    precise vec4 clip; // a map is the same bit for bit whichever of these shaders draws it
    clip = vec4(dot(row_x, p), dot(row_y, p), dot(row_z, p), 1.0);
#ifdef PERSPECTIVE
    clip.w = dot(row_w, p);
#endif
#ifdef PARABOLOID
    ray = vec4(clip.xyz, dot(row_metric, p));
    rim = casterRim(clip);
#elif defined(PERSPECTIVE)
    metric = dot(row_metric, p);
#elif defined(METRIC)
    metric = clip.z;
#endif
#ifdef IDS
    own = dot(row_own, p);
    id = casterPieceId(id_in.x, float(piece & uint(kMostPieces - 1)), id_in.y);
#endif
#ifdef CLIPPED
    gl_ClipDistance[0] = casterInside(position, clip_planes[0]);
    gl_ClipDistance[1] = casterInside(position, clip_planes[1]);
#endif
#ifdef LAYERED
    gl_Layer = int(layer);
#endif
#ifdef PARABOLOID
    gl_Position = casterParaboloid(clip);
#elif defined(LAYERED) && defined(PLACED)
    gl_Position = casterPlaced(clip, fitted[first_view + int(layer)].place);
#elif defined(PLACED)
    gl_Position = casterPlaced(clip, place);
#else
    gl_Position = clip;
#endif
#ifdef MASKED
    vec3 t = vec3(uv_in, 1.0);
    uv = vec2(dot(uv_u.xyz, t), dot(uv_v.xyz, t));
    colour = kColoured ? colour_in : vec4(1.0);
#endif
}
