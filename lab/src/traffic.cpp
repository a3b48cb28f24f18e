// SPDX-License-Identifier: Apache-2.0
#include "lab/traffic.h"

#include <gnomon/pack/filter_rule.h>

#include <vector>

namespace gnomon::lab {
namespace {

/// How far the mask pass must read at least. A filterable map was blurred before; with mip levels the one that fits has
/// a texel for each pixel, so that one of the finest level stands for what a pixel reads.
double leastReach(const ShadowOptions& options)
{
    const FilterTraits* traits = filterTraits(filterOf(options));
    if (traits == nullptr || !traits->filterable) {
        return reachTexels(options);
    }
    return options.moments.sampling == MapSampling::bilinear ? 1.0 : 0.5;
}

TrafficOptions trafficOf(const host::FrameRenderer& renderer, const host::RenderOptions& options)
{
    const FilterTraits* traits = filterTraits(filterOf(options.shadow));
    const MapPages& atlas = renderer.plan().pages[0];
    TrafficOptions traffic;
    traffic.format = formatOf(options.shadow);
    traffic.reach_texels = leastReach(options.shadow);
    traffic.image_layers = imageLayersPerMap(filterOf(options.shadow), options.shadow.moments);
    traffic.mip_levels = pack::mipLevels(resolvedOrThrow(options.shadow), atlas.width, atlas.height);
    traffic.redraws_all = !options.reuse_maps;
    traffic.reads_object_ids = renderer.masksReadIds();
    traffic.samples = options.anti_aliasing == host::AntiAliasing::ssaa4 ? 4 : 1;
    traffic.filterable = traits != nullptr && traits->filterable;
    traffic.depth_samples = options.shadow.moments.samples;
    traffic.blurred = blurRadius(options.shadow.moments) > 0;
    return traffic;
}

} // namespace

host::Picture geometryOf(const host::SceneOnGpu& scene, host::FrameRenderer& renderer, const Subject& subject,
                         host::RenderOptions options)
{
    constexpr host::WantedImages kGeometry{.colour = false, .geometry = true};
    if (options.shading == host::Shading::deferred) {
        return renderer.read(kGeometry);
    }
    options.shadows = false;
    options.shading = host::Shading::deferred;
    host::FrameRenderer another(scene, options);
    another.draw(*subject.state, subject.eye, subject.lights);
    return another.read(kGeometry);
}

std::uint64_t leastBytes(const host::Picture& geometry, const host::FrameRenderer& renderer, const Subject& subject,
                         const host::RenderOptions& options)
{
    if (!options.shadows) {
        return 0;
    }
    const Camera camera = host::cameraOf(subject.eye, options.width, options.height, subject.state->bounds_ws);
    std::vector<Light> lights;
    for (const host::ShadedLight& light : subject.lights) {
        lights.push_back(light.caster);
    }
    return leastBytes({camera, geometry.depth, geometry.normals}, lights, renderer.plan(),
                      trafficOf(renderer, options));
}

LeastByPass leastByPass(const host::FrameRenderer& renderer, const host::RenderOptions& options)
{
    if (!options.shadows) {
        return {};
    }
    return leastByPass(renderer.plan(), std::uint64_t{options.width} * options.height, trafficOf(renderer, options));
}

} // namespace gnomon::lab
