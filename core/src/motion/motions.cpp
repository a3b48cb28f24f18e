// SPDX-License-Identifier: Apache-2.0
#include "motion/motion.h"

namespace gnomon {
namespace {

constexpr MotionTraits kMotions[] = {
    {Motion::free, moveFreely, false},
    {Motion::snap, moveInTexels, true},
};

} // namespace

const MotionTraits* motionTraits(Motion motion)
{
    for (const MotionTraits& row : kMotions)
        if (row.motion == motion)
            return &row;
    return nullptr;
}

} // namespace gnomon
