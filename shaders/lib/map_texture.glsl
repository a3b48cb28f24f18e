// SPDX-License-Identifier: Apache-2.0
// GLSL only. Texels of the maps from one array texture: define GNOMON_MAP_SET and GNOMON_MAP_BINDING, and
// GNOMON_MAP_TEXEL_SIZE as an expression for (1 / width, 1 / height) of the atlas. The sampler's filter does not matter.
#ifndef GNOMON_MAP_TEXTURE_GLSL
#define GNOMON_MAP_TEXTURE_GLSL

layout(set = GNOMON_MAP_SET, binding = GNOMON_MAP_BINDING) uniform sampler2DArray gnomon_maps;

float mapTexel(vec2 texel, float layer)
{
    return texelFetch(gnomon_maps, ivec3(texel, layer), 0).r;
}

vec4 mapGather(vec2 corner, float layer)
{
    return textureGather(gnomon_maps, vec3(corner * GNOMON_MAP_TEXEL_SIZE, layer), 0);
}

#endif
