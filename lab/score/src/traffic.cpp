// SPDX-License-Identifier: Apache-2.0
#include "lab/score/traffic.h"

#include <gnomon/plan_views.h>

#include <cassert>

namespace gnomon::lab {
namespace {

/// Texels of a tile with its mip levels. It has the levels whose texels lie wholly in it.
struct LevelTexels {
    std::uint64_t finest = 0;
    std::uint64_t coarsest = 0; // the finest where it is the only one
    std::uint64_t all = 0;
};
LevelTexels texelsOf(const Tile& tile, std::uint32_t levels)
{
    const std::uint32_t edges = tile.x | tile.y | tile.width | tile.height;
    LevelTexels texels;
    texels.finest = std::uint64_t{tile.width} * tile.height;
    for (std::uint32_t level = 0; level < levels && edges % (1U << level) == 0; ++level) {
        texels.coarsest = std::uint64_t{tile.width >> level} * (tile.height >> level);
        texels.all += texels.coarsest;
    }
    return texels;
}

std::uint64_t texelsDrawn(const Plan& plan, const TrafficOptions& options)
{
    std::uint64_t texels = 0;
    for (const View& view : plan.views) {
        const bool whole = options.redraws_all || (view.contents.redraw && view.contents.kept_layer == kNoIndex);
        texels += whole ? texelsOf(view.place.tile, options.mip_levels).all : texelsRendered(view, false);
    }
    return texels * options.image_layers;
}

/// A byte for each channel (ShadowRenderer::mask()).
std::uint64_t maskBytes(const Plan& plan)
{
    return std::uint64_t{maskChannelCount(plan)} * plan.mask_layers;
}

PassLeast leastOfMaps(const Plan& plan, const TrafficOptions& options)
{
    PassLeast least;
    for (const View& view : plan.views) {
        least.texels += texelsRendered(view, options.redraws_all);
    }
    least.bytes = least.texels * (options.filterable ? kDepthBytes * options.depth_samples
                                                     : std::uint64_t{texelBytes(options.format)});
    return least;
}

PassLeast leastOfFilter(const Plan& plan, const TrafficOptions& options)
{
    PassLeast least;
    const std::uint64_t texel_bytes = std::uint64_t{texelBytes(options.format)} * options.image_layers;
    for (const View& view : plan.views) {
        if (!options.redraws_all && !view.contents.redraw) {
            continue;
        }
        const LevelTexels texels = texelsOf(view.place.tile, options.mip_levels);
        const std::uint64_t made = texels.finest * (options.blurred ? 5 : 1); // and twice read and written again
        const std::uint64_t averaged = (texels.all - texels.finest) + (texels.all - texels.coarsest);
        least.texels += texels.finest;
        least.bytes += texels.finest * kDepthBytes * options.depth_samples + (made + averaged) * texel_bytes;
    }
    return least;
}

bool halvesMask(const Plan& plan)
{
    return plan.options != nullptr && std::ranges::any_of(plan.lights, [&](const LightPlan& light) {
               return light.outcome.hasMap() && (*plan.options)[light.options].halvesMask();
           });
}

} // namespace

std::uint64_t texelsRendered(const View& view, bool redraws_all)
{
    const std::uint64_t all = std::uint64_t{view.place.tile.width} * view.place.tile.height;
    if (view.contents.kept_layer == kNoIndex) {
        return view.contents.redraw || redraws_all ? all : 0;
    }
    const std::uint64_t dirty = std::uint64_t{view.contents.dirty.width} * view.contents.dirty.height;
    return (view.contents.redraw_kept || redraws_all ? all : 0) + (redraws_all ? all : dirty);
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

LeastByPass leastByPass(const Plan& plan, std::uint64_t pixels, const TrafficOptions& options)
{
    LeastByPass least;
    if (!plan.views.empty()) {
        least.maps = leastOfMaps(plan, options);
        if (options.filterable) {
            least.filter = leastOfFilter(plan, options);
        }
    }
    if (!plan.lights.empty()) {
        const std::uint64_t mask_pixels = pixels * options.samples;
        const std::uint64_t through_half = halvesMask(plan) ? 2 * ((mask_pixels + 3) / 4) * maskBytes(plan) : 0;
        least.mask = PassLeast{mask_pixels, mask_pixels * (kDepthBytes + maskBytes(plan)) + through_half};
    }
    return least;
}

} // namespace gnomon::lab
