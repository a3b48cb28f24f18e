// SPDX-License-Identifier: Apache-2.0
#include "light_shares.h"

#include "light_space.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

bool isInView(const Light& light, const LightExtent& extent, const CameraView& camera)
{
    const glm::vec3 reach(static_cast<float>(extent.reach_m));
    const glm::vec3 place(light.position_ws);
    return light.type == LightType::directional ||
           classify(camera.planes, {place - reach, place + reach}) != Containment::outside;
}

} // namespace

double arrivesAt(const Light& light, const LightExtent& extent, const glm::dvec3& p_ws)
{
    if (light.type == LightType::directional) {
        return light.brightness;
    }
    const glm::dvec3 way = p_ws - light.position_ws;
    const double square = glm::dot(way, way);
    if (!(square <= extent.reach_m * extent.reach_m)) {
        return 0.0;
    }
    const double along = glm::dot(way, light.direction_ws);
    if (light.type == LightType::spot && !(along >= std::cos(light.outer_half_angle_rad) * std::sqrt(square))) {
        return 0.0;
    }
    return light.brightness / std::max(square, extent.near_m * extent.near_m);
}

void LightShares::find(std::span<const Light> lights, const CameraView& camera, std::span<const SightPoint> points)
{
    constexpr double kLeastInView = 0.05; // share of one of some hundred points
    all_.assign(points.size(), 0.0);
    shares_.assign(lights.size(), 0.0);
    for (const bool sums : {true, false}) {
        for (std::size_t light = 0; light < lights.size(); ++light) {
            if (!(lights[light].brightness > 0.0) || checkLight(lights[light]).kind != OutcomeKind::ok) {
                continue;
            }
            const LightExtent extent = extentOf(lights[light], camera.scene_ws);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double here = arrivesAt(lights[light], extent, points[i].p_ws);
                if (sums) {
                    all_[i] += here;
                } else if (here > 0.0) {
                    const double part = here / all_[i];
                    shares_[light] += part < 1.0 ? part : 1.0; // all of it where both are without end
                }
            }
            if (!sums && shares_[light] < kLeastInView && isInView(lights[light], extent, camera)) {
                shares_[light] = kLeastInView;
            }
        }
    }
}

} // namespace gnomon
