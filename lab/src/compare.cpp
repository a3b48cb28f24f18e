// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cassert>
#include <cmath>

namespace gnomon::lab {
namespace {

/// What frame.h says of near_m and range_m where they are 0.
double nearOf(const Light& light, const Aabb& scene_bounds_ws)
{
    if (light.near_m > 0.0) {
        return light.near_m;
    }
    double reach_m = light.range_m;
    if (!(reach_m > 0.0)) {
        const glm::dvec3 low = glm::abs(glm::dvec3(scene_bounds_ws.min) - light.position_ws);
        const glm::dvec3 high = glm::abs(glm::dvec3(scene_bounds_ws.max) - light.position_ws);
        reach_m = glm::length(glm::max(low, high));
    }
    return 0.001 * reach_m;
}

} // namespace

truth::View truthView(const Subject& subject, glm::uvec2 size_px)
{
    const Camera camera = host::cameraOf(subject.eye, size_px.x, size_px.y, subject.state->bounds_ws);
    return {.eye_ws = camera.eye_ws, .world_from_clip = glm::inverse(camera.clip_from_world), .size_px = size_px};
}

truth::Light truthLight(const Subject& subject)
{
    const Light& light = subject.lights[subject.light].caster;
    truth::Light out;
    switch (light.type) {
    case LightType::directional:
        out.type = scene::LightType::directional;
        break;
    case LightType::spot:
        out.type = scene::LightType::spot;
        break;
    case LightType::point:
        out.type = scene::LightType::point;
        break;
    }
    out.position_ws = light.position_ws;
    out.direction_ws = light.direction_ws;
    out.angular_diameter_rad = light.angular_diameter_rad;
    out.radius_m = light.radius_m;
    if (light.type != LightType::directional) {
        out.near_m = nearOf(light, subject.state->bounds_ws);
    }
    return out;
}

std::optional<double> truthNoise(const truth::Visibility& visibility, const Counted& counted)
{
    assert(visibility.standard_error.values.size() == counted.values.size());
    double sum = 0.0;
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < counted.values.size(); ++i) {
        if (counted.values[i] != 0) {
            const double error = visibility.standard_error.values[i];
            sum += error * error;
            ++count;
        }
    }
    if (count == 0) {
        return std::nullopt;
    }
    return std::sqrt(sum / static_cast<double>(count));
}

} // namespace gnomon::lab
