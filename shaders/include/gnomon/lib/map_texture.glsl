// SPDX-License-Identifier: Apache-2.0
// GLSL only. Texels of the maps from one array texture: define GNOMON_MAP_SET and GNOMON_MAP_BINDING, and
// GNOMON_MAP_TEXEL_SIZE as an expression for (1 / width, 1 / height) of the atlas. For filterable maps the sampler must
// be linear within and between mip levels and clamp to the edge; for all others its filter does not matter without GNOMON_NEAREST_MAPS. For lvsm
// define GNOMON_LAYERS_BINDING too: the storage buffer with the views' layers of depth. For pcss and raymarch define
// GNOMON_BLOCKS_BINDING: the image of the maps' blocks; for hard and pcf with GNOMON_SMOOTHIES that of their smoothies.
// For formats of two maps a texel (rg16 and rg16f of hard and pcf, rgba8) define GNOMON_DEPTH_HOLDING: kDepthChannel or
// kDepthBytes of gnomon/shared/paired_depth.h.
#ifndef GNOMON_MAP_TEXTURE_GLSL
#define GNOMON_MAP_TEXTURE_GLSL
#include "../shared/gpu_structs.h"
#include "compiled_filters.glsl"
#include "../shared/map_blocks.h"
#include "../shared/paired_depth.h"
// A pass in software whose sampler of these maps is a nearest one may define GNOMON_NEAREST_MAPS, a constant: see
// screen_surface.glsl.
#ifndef GNOMON_NEAREST_MAPS
#define GNOMON_NEAREST_MAPS false
#endif
#ifndef GNOMON_DEPTH_HOLDING
#define GNOMON_DEPTH_HOLDING kDepthAlone
#endif

layout(set = GNOMON_MAP_SET, binding = GNOMON_MAP_BINDING) uniform sampler2DArray gnomon_maps;

float mapTexel(vec2 texel, float layer, float part)
{
    vec4 held = GNOMON_NEAREST_MAPS ? textureLod(gnomon_maps, vec3((texel + 0.5) * GNOMON_MAP_TEXEL_SIZE, layer), 0.0)
                                    : texelFetch(gnomon_maps, ivec3(texel, layer), 0);
    return pairedDepth(GNOMON_DEPTH_HOLDING, held, part);
}

// A gather is of one channel, which must be a constant.
vec4 mapGather(vec2 corner, float layer, float part)
{
    vec3 at = vec3(corner * GNOMON_MAP_TEXEL_SIZE, layer);
    vec4 first = textureGather(gnomon_maps, at, 0);
    if (GNOMON_DEPTH_HOLDING == kDepthChannel) {
        if (part > 0.5) {
            return textureGather(gnomon_maps, at, 1);
        }
    }
    if (GNOMON_DEPTH_HOLDING == kDepthBytes) {
        vec4 low = textureGather(gnomon_maps, at, 1);
        if (part > 0.5) {
            first = textureGather(gnomon_maps, at, 2);
            low = textureGather(gnomon_maps, at, 3);
        }
        return vec4(depthFromBytes(first.x, low.x), depthFromBytes(first.y, low.y), depthFromBytes(first.z, low.z),
                    depthFromBytes(first.w, low.w));
    }
    return first;
}

// The second image of some filters beside a map: blocks, or smoothies.
#if GNOMON_COMPILES_BLOCKS || (defined(GNOMON_SMOOTHIES) && GNOMON_COMPILES_KERNELS)
layout(set = GNOMON_MAP_SET, binding = GNOMON_BLOCKS_BINDING) uniform usampler2DArray gnomon_blocks;
#endif
#if GNOMON_COMPILES_BLOCKS
vec2 mapBlock(vec2 block, int level, float layer)
{
    return blockDepths(int(texelFetch(gnomon_blocks, ivec3(block, layer), level - 1).x));
}
#endif
#if defined(GNOMON_SMOOTHIES) && GNOMON_COMPILES_KERNELS
int mapSmoothie(vec2 texel, float layer)
{
    return int(texelFetch(gnomon_blocks, ivec3(texel, layer), 0).x);
}
#endif

vec4 mapMoments(vec2 texel, float level, float layer)
{
    return textureLod(gnomon_maps, vec3(texel * GNOMON_MAP_TEXEL_SIZE, layer), level);
}

#if defined(GNOMON_LAYERS_BINDING) && GNOMON_COMPILES(GNOMON_FILTER_LVSM)
layout(set = GNOMON_MAP_SET, binding = GNOMON_LAYERS_BINDING, std430) readonly buffer GnomonDepthLayers
{
    GpuDepthLayers gnomon_depth_layers[]; // by slot
};
vec4 mapDepthLayer(int slot, int i)
{
    return gnomon_depth_layers[slot].layer[i];
}
#else
vec4 mapDepthLayer(int slot, int i)
{
    return vec4(0.0, 1.0, i == 0 ? 0.0 : 2.0, 0.5); // one layer that spans everything
}
#endif

#endif
