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
    bool clamp_near = false; // casters before the near plane are clamped onto it
    bool steady = false;     // MotionTraits::steady
    double texel_m = 0.0;
    double pad_m = 0.0;
    double least_m = 0.0; // the range is at least that
};
/// Share of a scene's largest side that a map's range of depth needs, for filters that follow a receiver's plane
/// exactly. Single precision rounds coordinates by some 1e-7 of that side, and those filters allow for depths that are
/// off by 4e-6 of the range. A floor straight across a light's axis has no range of its own, so this least range keeps
/// the rounding small beside it.
inline constexpr double kLeastRange = 0.0125;
/// As tight as the filter allows: precision is shared out between near and far (Marinescu 2011, eq. 1).
[[nodiscard]] DepthRange depthRangeOf(const DepthRangeInput& input);

/// Depth behind which nothing can cast on what is seen. For a steady map it changes in steps.
[[nodiscard]] double farthestCaster(const Region& region, const LightSpace& space, bool steady, double pad_m);

/// Eq. 6 of Marinescu 2011: the centre of the box, moved back against the light until every possible caster is in
/// front; as a depth along the light's axis. A light that has a place stays there.
[[nodiscard]] double lightPlaceOf(const Region& region, const LightSpace& space, double near_m);

} // namespace gnomon
