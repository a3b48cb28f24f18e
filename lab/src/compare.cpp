// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cassert>
#include <cmath>

namespace gnomon::lab {
namespace {

truth::Light castingLight(const Light& light, double near_m)
{
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
    out.near_m = light.type == LightType::directional ? 0.0 : near_m;
    return out;
}

constexpr double kNearShareOfReach = 0.001; // Light::near_m 0, as frame.h has it

} // namespace

truth::View truthView(const Subject& subject, glm::uvec2 size_px)
{
    const Camera camera = host::cameraOf(subject.eye, size_px.x, size_px.y, subject.state->bounds_ws);
    return {.eye_ws = camera.eye_ws, .world_from_clip = glm::inverse(camera.clip_from_world), .size_px = size_px};
}

truth::Light truthLight(const Light& light)
{
    return castingLight(light, light.near_m > 0.0 ? light.near_m : kNearShareOfReach * light.range_m);
}

truth::Light truthLight(const Subject& subject)
{
    const Light& light = subject.lights[subject.light].caster;
    if (light.near_m > 0.0 || light.range_m > 0.0) {
        return truthLight(light);
    }
    const Aabb& bounds = subject.state->bounds_ws;
    const glm::dvec3 low = glm::abs(glm::dvec3(bounds.min) - light.position_ws);
    const glm::dvec3 high = glm::abs(glm::dvec3(bounds.max) - light.position_ws);
    return castingLight(light, kNearShareOfReach * glm::length(glm::max(low, high)));
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
