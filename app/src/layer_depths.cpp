// SPDX-License-Identifier: Apache-2.0
#include "layer_depths.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon::app {
namespace {

bool storesZOverW(const View& view, const MomentOptions& options)
{
    return options.metric == DepthMetricKind::z_over_w && !view.projection.parallel;
}

} // namespace

double storedDepth(const View& view, const MomentOptions& options, const glm::dvec3& point_ws)
{
    const glm::dvec4 point(point_ws, 1.0);
    if (storesZOverW(view, options)) {
        const glm::dvec4 clip = view.projection.clip_from_world * point;
        return std::clamp(clip.z / clip.w, 0.0, 1.0);
    }
    return std::clamp(glm::dot(view.projection.metric.metric_ws, point), 0.0, 1.0);
}

double metresOf(const View& view, const MomentOptions& options, double stored)
{
    const double near_m = view.projection.metric.near_m;
    const double far_m = view.projection.metric.far_m;
    if (storesZOverW(view, options)) {
        return near_m * far_m / (far_m - stored * (far_m - near_m));
    }
    return near_m + stored * (far_m - near_m);
}

std::size_t layerOf(std::span<const pack::DepthLayer> layers, double stored)
{
    std::size_t found = 0;
    for (std::size_t i = 1; i < layers.size(); ++i) {
        found = static_cast<double>(layers[i].begins) <= stored ? i : found;
    }
    return found;
}

} // namespace gnomon::app
