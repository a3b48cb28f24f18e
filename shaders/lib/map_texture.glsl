// SPDX-License-Identifier: Apache-2.0
// GLSL only. Texels of the maps from one array texture: define GNOMON_MAP_SET and GNOMON_MAP_BINDING, and
// GNOMON_MAP_TEXEL_SIZE as an expression for (1 / width, 1 / height) of the atlas. For filterable maps the sampler must
// be linear within and between mip levels and clamp to the edge; for all others its filter does not matter. For lvsm
// define GNOMON_LAYERS_BINDING too: the storage buffer with the views' layers of depth.
#ifndef GNOMON_MAP_TEXTURE_GLSL
#define GNOMON_MAP_TEXTURE_GLSL
#include "../shared/gpu_structs.h"

layout(set = GNOMON_MAP_SET, binding = GNOMON_MAP_BINDING) uniform sampler2DArray gnomon_maps;

float mapTexel(vec2 texel, float layer)
{
    return texelFetch(gnomon_maps, ivec3(texel, layer), 0).r;
}

vec4 mapGather(vec2 corner, float layer)
{
    return textureGather(gnomon_maps, vec3(corner * GNOMON_MAP_TEXEL_SIZE, layer), 0);
}

vec4 mapMoments(vec2 texel, float level, float layer)
{
    return textureLod(gnomon_maps, vec3(texel * GNOMON_MAP_TEXEL_SIZE, layer), level);
}

#ifdef GNOMON_LAYERS_BINDING
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
