// SPDX-License-Identifier: Apache-2.0
#include "world_layers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Sine of ten degrees: as far as depth leans with receivers, too (depth_tilt.cpp).
constexpr double kLowest = 0.17364817766693;

} // namespace

glm::dvec3 heightDepth(const LightSpace& space)
{
    if (space.perspective || std::abs(space.forward_ws.y) < kLowest) {
        return space.forward_ws;
    }
    return {0.0, 1.0 / space.forward_ws.y, 0.0};
}

void placeLayers(std::span<const WorldLayer> layers, LayerAxis axis, const glm::dvec3& forward_ws, View& view)
{
    const glm::dvec4& row = view.projection.metric.metric_ws;
    const bool by_height = axis == LayerAxis::height;
    const auto count = static_cast<double>(layers.size());
    const bool is_level = row.x == 0.0 && row.z == 0.0;
    // d' at `metres`.
    const auto depthAt = [&](double metres) {
        if (!view.projection.parallel) {
            return (metres - view.projection.metric.near_m) /
                   (view.projection.metric.far_m - view.projection.metric.near_m);
        }
        return by_height ? row.y * metres + row.w : glm::dot(glm::dvec3(row), forward_ws) * metres + row.w;
    };
    view.serves.layers = {};
    for (std::size_t i = 0; i < layers.size(); ++i) {
        DepthSpan& span = view.serves.layers[i];
        if (by_height && !is_level) {
            span = {static_cast<double>(i) / count, static_cast<double>(i + 1) / count};
            continue;
        }
        const bool from_top = by_height && row.y < 0.0; // high layers are near to the light
        const WorldLayer& layer = layers[from_top ? layers.size() - 1 - i : i];
        const double low = depthAt(layer.low_m);
        const double high = depthAt(layer.high_m);
        span = {std::min(low, high), std::max(low, high)}; // near and far of eq. 5
    }
}

} // namespace gnomon
