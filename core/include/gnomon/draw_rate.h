// SPDX-License-Identifier: Apache-2.0
// What drawing shadow maps takes on a device, learnt from the frames that were measured: for a bound in milliseconds
// (ShadowOptions::draw_budget_ms). The planner has no clock, so a host that has one tells it.
#pragma once

#include <gnomon/export.h>

#include <cstdint>

namespace gnomon {

/// A running mean of milliseconds per texel. Large frames count for more than small ones, later ones for more than
/// earlier ones: by half after eight that drew as much. One hiccup moves it little: of a frame no more is believed than
/// four times what was expected of it, and no less than a quarter. So a device that has become 16 times as slow is
/// known as such after some ten frames.
class GNOMON_API DrawRate {
public:
    /// A frame drew so many texels of maps (MapPages::drawn_texels of all of the plan's options) and its passes for
    /// them took so long. One that drew none, or whose time is not a finite number above 0, tells nothing.
    void take(std::uint64_t texels, double ms);
    /// For Frame::draw_ms_per_texel. 0: no frame has told anything.
    [[nodiscard]] double msPerTexel() const { return texels_ > 0.0 ? ms_ / texels_ : 0.0; }
    /// Of another device or technique nothing is known.
    void forget() { *this = {}; }

private:
    double texels_ = 0.0; // with what later frames left of them
    double ms_ = 0.0;
};

} // namespace gnomon
