// SPDX-License-Identifier: Apache-2.0
#include "lab/traffic.h"

#include <vector>

namespace gnomon::lab {

std::uint64_t leastBytes(host::Renderer& renderer, const Subject& subject, const host::RenderOptions& options)
{
    if (!options.shadows) {
        return 0;
    }
    const host::Picture picture = renderer.read({.colour = false, .linear = false, .masks = false, .geometry = true});
    const Camera camera = host::cameraOf(subject.eye, options.width, options.height, subject.state->bounds_ws);
    std::vector<Light> lights;
    for (const host::ShadedLight& light : subject.lights) {
        lights.push_back(light.caster);
    }
    TrafficOptions traffic;
    traffic.format = options.filter.format;
    traffic.reach_texels = vulkan::filterReachTexels(options.filter);
    traffic.redraws_all = !options.reuse_maps;
    traffic.reads_object_ids = true;
    traffic.samples = options.anti_aliasing == host::AntiAliasing::ssaa4 ? 4 : 1;
    return leastBytes({camera, picture.depth, picture.normals}, lights, renderer.plan(), traffic);
}

} // namespace gnomon::lab
