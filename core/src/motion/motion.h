// SPDX-License-Identifier: Apache-2.0
// How a map follows a moving camera or sun. A motion is one file, and its declaration and row here.
#pragma once

#include "fit/projection.h"
#include "motion/sun_steps.h"
#include "partition/partition.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace gnomon {

struct MotionInput {
    const LightSpace& space;
    const Camera& camera;
    const CameraView& view; // measured
    const Slice& slice;
    double least_size = 0.0; // no side of a map is shorter, as LightRect has it
    std::uint32_t map_size = 0;
    double border_texels = 0.0;
    double light_reach = 0.0; // for a steady map: room on all sides, in units of LightRect (light_reach.h)
};
/// From the rectangle that matters now to the map that is drawn, which holds it and the border.
using MotionFunction = MapFrame (*)(const LightRect& wanted, const MotionInput& input);

struct MotionTraits {
    Motion motion;
    MotionFunction move;
    /// A map's rectangle and depths change only in steps: the rectangle is drawn whole, whatever is seen, with no warp,
    /// and the range of depth is a multiple of a power of two.
    bool steady;
    Stepping stepping; // for a directional light; others stay where they are
};
/// Why a steady map has no warp.
inline constexpr std::string_view kUnwarped =
    "a warped map has no texels of one size to move in whole steps, so it is drawn without warp";

MapFrame moveFreely(const LightRect& wanted, const MotionInput& input);
MapFrame moveInTexels(const LightRect& wanted, const MotionInput& input);

inline constexpr MotionTraits kMotions[] = {
    {Motion::free, moveFreely, false, Stepping::none},
    {Motion::snap, moveInTexels, true, Stepping::none},
    // From each of its positions a sun draws the map that `snap` does.
    {Motion::step_jump, moveInTexels, true, Stepping::jump},
    {Motion::step_band, moveInTexels, true, Stepping::band},
    {Motion::step_blend, moveInTexels, true, Stepping::blend},
    {Motion::step_alternate, moveInTexels, true, Stepping::alternate},
};

/// Null for what is not a motion.
[[nodiscard]] constexpr const MotionTraits* motionTraits(Motion motion)
{
    const auto* const row = std::ranges::find(kMotions, motion, &MotionTraits::motion);
    return row != std::end(kMotions) ? row : nullptr;
}

} // namespace gnomon
