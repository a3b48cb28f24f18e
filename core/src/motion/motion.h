// SPDX-License-Identifier: Apache-2.0
// How a map follows a moving camera or sun. A motion is one file and one line in motions.cpp.
#pragma once

#include "light_space.h"

namespace gnomon {

struct MotionInput {
    std::uint32_t map_size = 0;
    double border_texels = 0.0;
};
/// From the rectangle that matters now to the one that is drawn, which contains it.
using MotionFunction = LightRect (*)(const LightRect& wanted, const MotionInput& input);

/// Null for a motion that is not available.
[[nodiscard]] MotionFunction motionFunction(Motion motion);

LightRect moveFreely(const LightRect& wanted, const MotionInput& input);

} // namespace gnomon
