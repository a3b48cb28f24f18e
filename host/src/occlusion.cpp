// SPDX-License-Identifier: Apache-2.0
#include "occlusion.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace gnomon::host {
namespace {

Image make(Memory& memory, const char* name, VkExtent2D drawn)
{
    ImageWish wish;
    wish.name = name;
    wish.purpose = "ambient occlusion";
    wish.format = kOcclusionFormat;
    wish.extent = {drawn.width / 2 + 1, drawn.height / 2 + 1};
    wish.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    return memory.image(wish);
}

} // namespace

Occlusion::Occlusion(Memory& memory, Pipelines& pipelines, VkExtent2D drawn)
    : searched(make(memory, "occlusion as found", drawn)), smooth(make(memory, "occlusion", drawn)),
      search(pipelines.occlusionSearch()), smoothen(pipelines.occlusionSmooth())
{
}

double occlusionRadius(const scene::State& state)
{
    std::vector<double> sizes;
    for (const scene::Object& object : state.objects) {
        if (object.bounds_ws.min.x > object.bounds_ws.max.x) continue;
        sizes.push_back(glm::length(glm::dvec3(object.bounds_ws.max - object.bounds_ws.min)));
    }
    std::sort(sizes.begin(), sizes.end());
    const double whole = glm::length(glm::dvec3(state.bounds_ws.max - state.bounds_ws.min));
    const double median = sizes.empty() ? whole : sizes[sizes.size() / 2];
    if (std::getenv("AO_DEBUG")) std::fprintf(stderr, "whole %g median %g q75 %g q90 %g n %zu\n", whole, median, sizes[sizes.size()*3/4], sizes[sizes.size()*9/10], sizes.size());
    if (std::getenv("AO_RADIUS")) return std::atof(std::getenv("AO_RADIUS"));
    return std::min(0.25 * median, 0.03 * whole);
}

} // namespace gnomon::host
