// SPDX-License-Identifier: Apache-2.0
#include "motion/motion.h"

namespace gnomon {
namespace {

struct Row {
    Motion motion;
    MotionFunction function;
};
constexpr Row kMotions[] = {
    {Motion::free, moveFreely},
};

} // namespace

MotionFunction motionFunction(Motion motion)
{
    for (const Row& row : kMotions)
        if (row.motion == motion)
            return row.function;
    return nullptr;
}

} // namespace gnomon
