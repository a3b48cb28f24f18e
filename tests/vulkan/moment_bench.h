// SPDX-License-Identifier: Apache-2.0
// Filterable maps of the scene of boxes, read back, and the CPU's values for the same depths.
#pragma once

#include "cpu_map.h"
#include "fixture.h"

#include <functional>

namespace gnomon::test {

/// A sun's view of 256 x 256 texels and a spot's of 160 x 96 beside it, away from the atlas's corner.
[[nodiscard]] Plan momentPlan(const Scene& scene);

struct DrawnMaps {
    std::vector<CpuMap> layers; // of the image, all of its mip levels
    vulkan::FilterCost cost;
    std::vector<std::vector<pack::DepthLayer>> depth_layers; // by view
};
/// Draws this plan's maps once, with validation.
[[nodiscard]] DrawnMaps drawMaps(const Scene& scene, const Plan& plan, const ShadowOptions& filter);
/// The depths under each texel of a layer: a hard shadow's map.
[[nodiscard]] CpuMap drawDepths(const Scene& scene, const Plan& plan);

[[nodiscard]] ShadowOptions momentFilter(Filter filter, MapFormat format);
/// The filter's stored value for depths in the linear metric, averaged; by image layer of the map.
[[nodiscard]] glm::dvec4 encodeSamples(const ShadowOptions& filter, const View& view,
                                       const std::vector<pack::DepthLayer>& layers, std::uint32_t image_layer,
                                       std::span<const double> depths);
/// Averages as the filter's maps are to be averaged; the weights add up to 1.
[[nodiscard]] glm::dvec4 averageStored(const ShadowOptions& filter,
                                       std::span<const std::pair<glm::dvec4, double>> weighted);

/// The largest error of a stored value.
[[nodiscard]] double storageError(MapFormat format);
[[nodiscard]] int channelsOf(MapFormat format);

} // namespace gnomon::test
