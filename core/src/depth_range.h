// SPDX-License-Identifier: Apache-2.0
// Between which depths a map's metric is shared out.
#pragma once

#include "region.h"

namespace gnomon {

struct DepthRange {
    double near_m = 0.0; // as LightSpace::depth_ws measures it, from its origin
    double far_m = 1.0;
};

struct DepthRangeInput {
    const Region& region; // with its casters
    const LightSpace& space;
    bool clamp_near = false; // what is before the near plane is clamped onto it
    bool steady = false;     // MotionTraits::steady
    double texel_m = 0.0;
    double pad_m = 0.0;
    double least_m = 0.0; // the range is at least that
};
/// Share of a scene's largest side that a map's range of depth needs, for filters that follow a receiver's plane
/// exactly. What single precision rounds coordinates by is some 1e-7 of that side, and those filters reckon with depths
/// that are off by 4e-6 of the range: a floor straight across a light's axis has no range of its own beside which that
/// is little.
inline constexpr double kLeastRange = 0.0125;
/// As tight as the filter allows: precision is shared out between near and far (Marinescu 2011, eq. 1).
[[nodiscard]] DepthRange depthRangeOf(const DepthRangeInput& input);

/// Depth behind which nothing can cast on what is seen. Of a steady map it changes in steps.
[[nodiscard]] double farthestCaster(const Region& region, const LightSpace& space, bool steady, double pad_m);

/// Eq. 6 of Marinescu 2011: the centre of the box, backed out against the light until everything that can cast is in
/// front; as a depth along the light's axis. A light that has a place stays there.
[[nodiscard]] double lightPlaceOf(const Region& region, const LightSpace& space, double near_m);

} // namespace gnomon
