// SPDX-License-Identifier: Apache-2.0
#include "lab/score/score.h"

#include "lab/metrics/flip.h"
#include "lab/metrics/same_shape.h"
#include "scene/state.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cassert>
#include <cmath>

namespace gnomon::lab {

truth::View truthView(const Camera& camera, glm::uvec2 size_px)
{
    return {.eye_ws = camera.eye_ws, .world_from_clip = glm::inverse(clipFromWorld(camera)), .size_px = size_px};
}

truth::Light truthLight(const Light& light)
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
    out.near_m = light.near_m;
    out.groups = light.groups;
    return out;
}

Score scoreMask(const Judged& judged, const truth::Traced& truth, const ImageOf<std::uint32_t>& object_ids,
                const ImageF& mask, bool with_perception)
{
    const ImageF& exact = truth.visibility.visibility;
    assert(areMasksOfOneSize(mask, exact));
    Score score;
    score.mask = mask;
    score.pixels = countPixels(judged, truth.surfaces, object_ids);
    score.density.map = ImageF(mask.width, mask.height, 1);
    const Counted& counted = score.pixels.counted;
    score.error = errorNumbers(mask, exact, counted);
    if (const std::optional<ErrorNumbers> grazing = errorNumbers(mask, exact, score.pixels.grazing)) {
        score.grazing_rmse = grazing->rmse;
    }
    score.classification =
        classifyErrors(mask, exact, counted, score.pixels.terminator, truth.visibility.first_blocker_m,
                       glm::length(glm::dvec3(judged.state.bounds_ws.extent())));
    if (with_perception) {
        score.ssim = ssim(mask, exact, counted);
        score.flip = flip(mask, exact, counted);
    }
    return score;
}

std::optional<double> truthNoise(const truth::Visibility& visibility, const Counted& counted)
{
    assert(areMasksOfOneSize(visibility.standard_error, counted));
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
