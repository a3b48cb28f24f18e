// SPDX-License-Identifier: Apache-2.0
#include "lab/score/score.h"

#include "lab/metrics/same_shape.h"
#include "pixel_rays.h"
#include "scene/state.h"

#include <cassert>
#include <cmath>

namespace gnomon::lab {
namespace {

glm::dvec3 vectorAt(const ImageF& image, std::uint32_t x, std::uint32_t y)
{
    const float* v = image.pixel(x, y);
    return {v[0], v[1], v[2]};
}

class PixelJudge {
public:
    PixelJudge(const Judged& judged, const truth::Surfaces& surfaces, const ImageOf<std::uint32_t>& object_ids)
        : judged_(judged), surfaces_(surfaces), object_ids_(object_ids)
    {
    }
    /// The tally that a pixel belongs to: of the reasons to leave it out the first that holds, in PixelCounts' order.
    [[nodiscard]] std::uint64_t PixelCounts::*tallyOf(std::uint32_t x, std::uint32_t y) const
    {
        const std::uint32_t id = *surfaces_.object_ids.pixel(x, y);
        if (id != *object_ids_.pixel(x, y)) {
            return &PixelCounts::other_object;
        }
        if (id == 0) {
            return &PixelCounts::background;
        }
        const glm::dvec3 point_ws = judged_.camera.eye_ws + vectorAt(surfaces_.points, x, y);
        const double facing = facingAt(surfaces_.smooth_normals, x, y);
        if (!(facing > 0.0)) {
            return &PixelCounts::facing_away;
        }
        if (!shinesOn(judged_.light, point_ws)) {
            return &PixelCounts::unlit;
        }
        if (!judged_.state.objects[id - 1].receives) {
            return &PixelCounts::no_receiver;
        }
        return facing > kFacing ? &PixelCounts::counted : &PixelCounts::grazing;
    }

    /// Whether a counted pixel is at the terminator.
    [[nodiscard]] bool isTerminator(std::uint32_t x, std::uint32_t y) const
    {
        return !(facingAt(surfaces_.normals, x, y) > kFacing);
    }

private:
    [[nodiscard]] double facingAt(const ImageF& normals_ws, std::uint32_t x, std::uint32_t y) const
    {
        const glm::dvec3 point_ws = judged_.camera.eye_ws + vectorAt(surfaces_.points, x, y);
        return glm::dot(vectorAt(normals_ws, x, y), towardsLight(judged_.light, point_ws));
    }

    const Judged& judged_;
    const truth::Surfaces& surfaces_;
    const ImageOf<std::uint32_t>& object_ids_;
};

} // namespace

CountedPixels countPixels(const Judged& judged, const truth::Surfaces& surfaces,
                          const ImageOf<std::uint32_t>& object_ids)
{
    assert(areMasksOfOneSize(surfaces.object_ids, object_ids));
    const PixelJudge judge(judged, surfaces, object_ids);
    CountedPixels result;
    result.counted = Counted(object_ids.width, object_ids.height, 1);
    result.terminator = Counted(object_ids.width, object_ids.height, 1);
    result.grazing = Counted(object_ids.width, object_ids.height, 1);
    for (std::uint32_t y = 0; y < object_ids.height; ++y) {
        for (std::uint32_t x = 0; x < object_ids.width; ++x) {
            std::uint64_t PixelCounts::*tally = judge.tallyOf(x, y);
            ++(result.counts.*tally);
            *result.counted.pixel(x, y) = tally == &PixelCounts::counted ? 1 : 0;
            *result.grazing.pixel(x, y) = tally == &PixelCounts::grazing ? 1 : 0;
            if (tally == &PixelCounts::counted && judge.isTerminator(x, y)) {
                *result.terminator.pixel(x, y) = 1;
                ++result.counts.terminator;
            }
        }
    }
    return result;
}

} // namespace gnomon::lab
