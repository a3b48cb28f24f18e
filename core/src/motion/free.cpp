// SPDX-License-Identifier: Apache-2.0
// The tightest rectangle in every frame: the finest texels, which crawl over the ground as the camera moves.
#include "motion/motion.h"

namespace gnomon {

MapFrame moveFreely(const LightRect& wanted, const MotionInput& input)
{
    return frameOf(wanted, input.least_size, input.map_size, input.border_texels);
}

} // namespace gnomon
