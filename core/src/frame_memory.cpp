// SPDX-License-Identifier: Apache-2.0
#include "frame_memory.h"

#include <algorithm>

namespace gnomon {

bool FrameMemory::holds(const Frame& frame) const
{
    return known_ && frame.objects != nullptr && frame.objects->identity() == objects_ &&
           frame.objects->version() == version_ && frame.size_px == size_px_ && frame.camera == camera_ &&
           frame.clamps_depth == clamps_depth_ && frame.rates == rates_ && std::ranges::equal(frame.layers, layers_) &&
           std::ranges::equal(frame.lights, lights_);
}

bool FrameMemory::sees(const Frame& frame) const
{
    return known_ && frame.size_px == size_px_ && sameSight(camera_, frame.camera, size_px_);
}

void FrameMemory::note(const Frame& frame)
{
    known_ = frame.objects != nullptr;
    camera_ = frame.camera;
    size_px_ = frame.size_px;
    clamps_depth_ = frame.clamps_depth;
    rates_ = frame.rates;
    lights_.assign(frame.lights.begin(), frame.lights.end());
    layers_.assign(frame.layers.begin(), frame.layers.end());
    objects_ = known_ ? frame.objects->identity() : 0;
    version_ = known_ ? frame.objects->version() : 0;
}

} // namespace gnomon
