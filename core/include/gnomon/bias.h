// SPDX-License-Identifier: Apache-2.0
// How a receiver is kept from shadowing itself.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (depth aliasing); the arithmetic is in
// shaders/shared/bias.h.
#pragma once

namespace gnomon {

/// `automatic` derives everything from the texel's footprint, the kernel's reach and the receiver's plane, so nothing
/// needs tuning when the map's size, the fit or the kernel changes; the other fields are then ignored.
struct BiasOptions {
    bool automatic = true;
    float constant_m = 0.0F;     // metres towards the light; any finite value (negative to show what goes wrong)
    float slope = 0.0F;          // times the depth that one texel spans on the receiver; 0 .. 16
    float normal_texels = 0.0F;  // receiver moved along its normal by this many texels' width; 0 .. 16
    bool receiver_plane = false; // each tap is compared with the receiver's plane at that tap

    bool operator==(const BiasOptions&) const = default;
};

} // namespace gnomon
