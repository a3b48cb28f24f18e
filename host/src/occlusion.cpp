// SPDX-License-Identifier: Apache-2.0
#include "occlusion.h"

#include "model_bounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
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

double occlusionRadius(const scene::Scene& scene, const scene::State& state)
{
    // A quarter of what is of middling size, so that crowds have it as trees have; and little of the whole, where one
    // mesh is all there is.
    constexpr double kOfMedian = 0.25;
    constexpr double kOfWhole = 0.03;
    const auto diagonal = [](const Aabb& box) {
        return glm::length(glm::dvec3(box.max) - glm::dvec3(box.min));
    };
    std::vector<double> sizes;
    for (const scene::Object& object : state.objects) {
        if (!object.bounds_ws.empty() && !fades(scene, object)) { // planes may have left nothing
            sizes.push_back(diagonal(object.bounds_ws));
        }
    }
    if (sizes.empty()) {
        return 1.0;
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return std::max(std::min(kOfMedian * *middle, kOfWhole * diagonal(modelBounds(scene, state))), 1e-6);
}

} // namespace gnomon::host
