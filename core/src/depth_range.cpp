// SPDX-License-Identifier: Apache-2.0
#include "depth_range.h"

#include "motion/steps.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Casters far above all receivers are clamped onto a near plane this far before them: a multiple of their own range or
/// a number of texels, whichever is more. A bias is some texels of depth, and more on a slope; a caster clamped closer
/// than that would cast no shadow on the receivers next to the plane, and none at all on a flat floor, whose own range
/// is 0.
constexpr double kClearanceRanges = 3.0;
constexpr double kClearanceTexels = 64.0;
/// Share of the range that is added at its ends.
constexpr double kMargin = 1e-4;

} // namespace

DepthRange depthRangeOf(const DepthRangeInput& input)
{
    const Region& region = input.region;
    const LightSpace& space = input.space;
    if (input.steady && space.perspective) { // and what is at the reach itself is not beyond it by rounding
        return {space.near_m, space.reach_m + kMargin * (space.reach_m - space.near_m)};
    }
    DepthRange range{region.casterNear_m(), region.receiverFar_m()};
    if (input.clamp_near) {
        const double own_m = region.receiverFar_m() - region.receiverNear_m();
        const double clearance_m = std::max(kClearanceRanges * own_m, kClearanceTexels * input.texel_m);
        range.near_m = std::max(range.near_m, region.receiverNear_m() - clearance_m);
    }
    range.near_m = std::min(range.near_m, range.far_m);
    const double margin_m = kMargin * (range.far_m - range.near_m) + input.pad_m;
    range.near_m -= margin_m;
    range.far_m += margin_m;
    if (space.perspective) {
        range.near_m = std::max(range.near_m, space.near_m);
    }
    const double least_m = std::max({margin_m, input.least_m, 1e-9 * std::abs(range.near_m)});
    range.far_m = std::max(range.far_m, range.near_m + least_m);
    if (input.steady) {
        const SteppedRange stepped = steppedRange(range.near_m, range.far_m);
        return {stepped.low, stepped.high};
    }
    return range;
}

double farthestCaster(const Region& region, const LightSpace& space, bool steady, double pad_m)
{
    if (!steady) {
        return region.receiverFar_m();
    }
    return space.perspective ? space.reach_m
                             : steppedRange(region.receiverNear_m(),
                                            std::max(region.receiverFar_m(), region.receiverNear_m() + 32.0 * pad_m))
                                   .high;
}

double lightPlaceOf(const Region& region, const LightSpace& space, double near_m)
{
    return space.perspective ? 0.0 : std::min({region.casterNear_m(), region.receiverNear_m(), near_m});
}

} // namespace gnomon
