// SPDX-License-Identifier: Apache-2.0
#include "lab/score/traffic.h"

#include <cassert>

namespace gnomon::lab {
namespace {

/// Of a tile with its mip levels, of which there are those whose texels lie in it wholly.
std::uint64_t texelsOf(const Tile& tile, std::uint32_t levels)
{
    const std::uint32_t edges = tile.x | tile.y | tile.width | tile.height;
    std::uint64_t texels = 0;
    for (std::uint32_t level = 0; level < levels && edges % (1U << level) == 0; ++level) {
        texels += std::uint64_t{tile.width >> level} * (tile.height >> level);
    }
    return texels;
}

std::uint64_t texelsDrawn(const Plan& plan, const TrafficOptions& options)
{
    std::uint64_t texels = 0;
    for (const View& view : plan.views) {
        const bool whole = options.redraws_all || (view.redraw && view.kept_layer == kNoIndex);
        texels += whole ? texelsOf(view.tile, options.mip_levels) : texelsRendered(view, false);
    }
    return texels * options.image_layers;
}

/// A byte for each channel (ShadowRenderer::mask()).
std::uint64_t maskBytes(const Plan& plan)
{
    return std::uint64_t{maskChannelCount(plan)} * plan.mask_layers;
}

} // namespace

std::uint64_t texelsRendered(const View& view, bool redraws_all)
{
    const std::uint64_t all = std::uint64_t{view.tile.width} * view.tile.height;
    if (view.kept_layer == kNoIndex) {
        return view.redraw || redraws_all ? all : 0;
    }
    const std::uint64_t dirty = std::uint64_t{view.dirty.width} * view.dirty.height;
    return (view.redraw_kept || redraws_all ? all : 0) + (redraws_all ? all : dirty);
}

std::uint32_t texelBytes(MapFormat format)
{
    switch (format) {
    case MapFormat::r8:
        return 1;
    case MapFormat::r16f:
    case MapFormat::d16:
    case MapFormat::r16:
    case MapFormat::rg8:
        return 2;
    case MapFormat::d32f:
    case MapFormat::r32f:
    case MapFormat::rg16:
    case MapFormat::rg16f:
    case MapFormat::rgba8:
    case MapFormat::d24:
        return 4;
    case MapFormat::rg32f:
    case MapFormat::rgba16:
    case MapFormat::rgba16f:
        return 8;
    case MapFormat::rgba32f:
        return 16;
    }
    return 0;
}

std::uint64_t leastBytes(const Sight& seen, std::span<const Light> lights, const Plan& plan,
                         const TrafficOptions& options)
{
    if (plan.lights.empty()) {
        return 0;
    }
    assert(lights.size() == plan.lights.size());
    std::uint64_t texels = texelsDrawn(plan, options);
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
        if (plan.lights[light].outcome.hasMap()) {
            texels += texelUse(seen, facingPixels(seen, lights[light]), plan, light, options.reach_texels).read;
        }
    }
    const std::uint64_t pixels = std::uint64_t{seen.depth.width} * seen.depth.height * options.samples;
    const std::uint64_t pixel_bytes =
        kDepthBytes + kNormalBytes + (options.reads_object_ids ? kObjectIdBytes : 0) + maskBytes(plan);
    return texels * texelBytes(options.format) + pixels * pixel_bytes;
}

} // namespace gnomon::lab
