// SPDX-License-Identifier: Apache-2.0
#include "motion/motion.h"

namespace gnomon {
namespace {

constexpr MotionTraits kMotions[] = {
    {Motion::free, moveFreely, false, Stepping::none},
    {Motion::snap, moveInTexels, true, Stepping::none},
    // From each of its positions a sun draws the map that `snap` does.
    {Motion::step_jump, moveInTexels, true, Stepping::jump},
    {Motion::step_band, moveInTexels, true, Stepping::band},
    {Motion::step_blend, moveInTexels, true, Stepping::blend},
    {Motion::step_alternate, moveInTexels, true, Stepping::alternate},
};

} // namespace

const MotionTraits* motionTraits(Motion motion)
{
    for (const MotionTraits& row : kMotions) {
        if (row.motion == motion) {
            return &row;
        }
    }
    return nullptr;
}

} // namespace gnomon
