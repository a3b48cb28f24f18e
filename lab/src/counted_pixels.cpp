// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include "pixel_rays.h"

#include <cassert>
#include <cmath>

namespace gnomon::lab {
namespace {

glm::dvec3 vectorAt(const ImageF& image, std::uint32_t x, std::uint32_t y)
{
    const float* v = image.pixel(x, y);
    return {v[0], v[1], v[2]};
}

/// Does the light shine on a point at all, if nothing is in the way?
bool shinesOn(const Light& light, const glm::dvec3& point_ws)
{
    if (light.type == LightType::directional) {
        return true;
    }
    const glm::dvec3 ray = point_ws - light.position_ws;
    const double distance = glm::length(ray);
    if (light.range_m > 0.0 && distance > light.range_m) {
        return false;
    }
    return light.type != LightType::spot ||
           glm::dot(ray, light.direction_ws) > std::cos(light.outer_half_angle_rad) * distance;
}

class PixelJudge {
public:
    PixelJudge(const Subject& subject, const truth::Surfaces& surfaces, const host::Picture& picture)
        : subject_(subject), light_(subject.lights[subject.light].caster), surfaces_(surfaces), picture_(picture)
    {
    }
    /// The tally that a pixel belongs to: of the reasons to leave it out the first that holds, in PixelCounts' order.
    [[nodiscard]] std::uint64_t PixelCounts::*tallyOf(std::uint32_t x, std::uint32_t y) const
    {
        const std::uint32_t id = *surfaces_.object_ids.pixel(x, y);
        if (id != *picture_.object_ids.pixel(x, y)) {
            return &PixelCounts::other_object;
        }
        if (id == 0) {
            return &PixelCounts::background;
        }
        const glm::dvec3 point_ws = subject_.eye.position_ws + vectorAt(surfaces_.points, x, y);
        const glm::dvec3 normal_ws = vectorAt(surfaces_.normals, x, y);
        if (!(glm::dot(normal_ws, towardsLight(light_, point_ws)) > kFacing)) {
            return &PixelCounts::facing_away;
        }
        if (!shinesOn(light_, point_ws)) {
            return &PixelCounts::unlit;
        }
        return subject_.state->objects[id - 1].receives ? &PixelCounts::counted : &PixelCounts::no_receiver;
    }

private:
    const Subject& subject_;
    const Light& light_;
    const truth::Surfaces& surfaces_;
    const host::Picture& picture_;
};

} // namespace

CountedPixels countPixels(const Subject& subject, const truth::Surfaces& surfaces, const host::Picture& picture)
{
    const std::uint32_t width = surfaces.object_ids.width;
    const std::uint32_t height = surfaces.object_ids.height;
    assert(picture.object_ids.width == width && picture.object_ids.height == height);
    const PixelJudge judge(subject, surfaces, picture);
    CountedPixels result;
    result.counted = Counted(width, height, 1);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            std::uint64_t PixelCounts::*tally = judge.tallyOf(x, y);
            ++(result.counts.*tally);
            *result.counted.pixel(x, y) = tally == &PixelCounts::counted ? 1 : 0;
        }
    }
    return result;
}

} // namespace gnomon::lab
