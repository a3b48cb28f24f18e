// SPDX-License-Identifier: Apache-2.0
// How long drawing shadow maps takes on a device, learnt from measured frames: for a bound in milliseconds
// (ShadowOptions::draw_budget_ms). The planner has no clock, so a host that has one tells it.
#pragma once

#include <gnomon/export.h>

#include <cstdint>

namespace gnomon {

/// A running mean of milliseconds per texel. Large frames count for more than small ones. Later frames count for more
/// than earlier ones: a frame's weight halves after eight frames that drew as much. One hiccup moves the mean little: a
/// frame's time is clamped to between a quarter and four times the expected time. So the mean knows after some ten
/// frames that a device has become 16 times as slow.
class GNOMON_API DrawRate {
public:
    /// Takes the number of map texels that a frame drew (MapPages::drawn_texels of all of the plan's options) and the
    /// time of its passes. A frame without texels, or whose time is not a finite number above 0, is ignored.
    void take(std::uint64_t texels, double ms);
    /// The mean, for Frame::draw_ms_per_texel. 0: no frame has been taken yet.
    [[nodiscard]] double msPerTexel() const { return texels_ > 0.0 ? ms_ / texels_ : 0.0; }
    /// Forgets all frames, for another device or technique.
    void forget() { *this = {}; }

private:
    double texels_ = 0.0; // texels of all frames, each with its weight
    double ms_ = 0.0;
};

} // namespace gnomon
