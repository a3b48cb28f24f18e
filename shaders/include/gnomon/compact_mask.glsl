// SPDX-License-Identifier: Apache-2.0
// GLSL only, for hosts: where a pixel's lights are in a compact mask (ShadowRendererOptions::compact). A host may define
// GNOMON_TILES_SET and GNOMON_TILES_BINDING beforehand, a storage buffer: ShadowRenderer::maskTiles(), or one filled by
// pack::fillMaskTiles().
#ifndef GNOMON_COMPACT_MASK_GLSL
#define GNOMON_COMPACT_MASK_GLSL
#ifndef GNOMON_TILES_SET
// Descriptor set of the buffer.
#define GNOMON_TILES_SET 0
#endif
#ifndef GNOMON_TILES_BINDING
// Its binding there.
#define GNOMON_TILES_BINDING 0
#endif

// The words of fillMaskTiles().
layout(set = GNOMON_TILES_SET, binding = GNOMON_TILES_BINDING, std430) restrict readonly buffer GnomonMaskTiles
{
    uvec2 gnomon_mask_tiles[];
};

// The lights that may reach a pixel, gnomonTileLight(first) to gnomonTileLight(first + count - 1).
struct GnomonTileLights {
    uint first; // the first light, for gnomonTileLight()
    uint masked; // how many lights have channels: the first ones
    uint count;  // how many lights there are
};
// The lights of a pixel of the mask.
GnomonTileLights gnomonTileLights(ivec2 pixel)
{
    uvec2 head = gnomon_mask_tiles[0];
    uvec2 tile = uvec2(pixel) / head.x;
    uvec2 here = gnomon_mask_tiles[1u + tile.y * head.y + tile.x];
    return GnomonTileLights(here.x, here.y & 0xFFFFu, here.y >> 16);
}

// One light of a tile.
struct GnomonTileLight {
    uint light;   // its index in the frame
    uint channel; // in the tile: layer * 4 + channel of the mask; 255: it has no map and is fully visible
    float weight; // its weight in that channel
};
// Reads light `i`, counted from GnomonTileLights::first on.
GnomonTileLight gnomonTileLight(uint i)
{
    uvec2 words = gnomon_mask_tiles[i];
    return GnomonTileLight(words.x & 0xFFFFFFu, words.x >> 24, uintBitsToFloat(words.y));
}

// A light's visibility at the pixel, 0 .. 1; for a light that shares its channel, the mean of the lights that do.
float gnomonTileVisibility(sampler2DArray mask, ivec2 pixel, GnomonTileLight light)
{
    return light.channel == 255u ? 1.0 : texelFetch(mask, ivec3(pixel, light.channel >> 2), 0)[light.channel & 3u];
}

#endif
