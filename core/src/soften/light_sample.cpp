// SPDX-License-Identifier: Apache-2.0
#include "soften/light_sample.h"

#include "light_space.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

LightSample sampleOf(const Light& light, const ConvergeSample& sample)
{
    LightSample made;
    made.joined = true;
    made.position_ws = light.position_ws;
    made.direction_ws = light.direction_ws;
    if (sample.light == glm::dvec3(0.0)) {
        return made;
    }
    // A light that shines all around has no axis.
    const bool all_around = layoutOf(light) == LightType::point;
    const glm::dvec3 axis_ws = all_around ? glm::dvec3(0.0, -1.0, 0.0) : glm::normalize(light.direction_ws);
    glm::dvec3 right_ws(0.0);
    glm::dvec3 up_ws(0.0);
    axesAcross(axis_ws, right_ws, up_ws);
    const glm::dvec3 aside_ws = right_ws * sample.light.x + up_ws * sample.light.y;
    if (light.type == LightType::directional) {
        constexpr double kWidestHalf_rad = 1.2; // a sky's width; its tangent is still a number to plan by
        const double tangent = std::tan(std::min(0.5 * light.angular_diameter_rad, kWidestHalf_rad));
        made.direction_ws = glm::normalize(axis_ws + aside_ws * tangent);
    } else {
        made.position_ws += (aside_ws + axis_ws * sample.light.z) * light.radius_m;
    }
    return made;
}

Light sampledLight(const Light& light, const LightSample& sample)
{
    Light from = light;
    if (sample.joined) {
        from.position_ws = sample.position_ws;
        from.direction_ws = sample.direction_ws;
    }
    return from;
}

} // namespace gnomon
