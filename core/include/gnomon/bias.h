// SPDX-License-Identifier: Apache-2.0
// How a receiver is kept from shadowing itself.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (depth aliasing); the arithmetic is in
// gnomon/shared/bias.h. The midpoint: A. Woo, "The Shadow Depth Map Revisited", Graphics Gems III, 1992.
#pragma once

#include <gnomon/export.h>

#include <cstdint>
#include <string_view>

namespace gnomon {

/// Which surface of the casters along a ray of light a map holds. `back` needs casters that have a thickness. A host
/// says which casters are open or thin (CasterBatch::two_sided); of these a map holds the nearest surface all the same,
/// so that they cast.
enum class CasterFaces : std::uint8_t {
    nearest,
    back, // the nearest that faces away from the light: the map holds no lit surface, so none can shadow itself
    /// Midway between the first surface and the second, or the first where there is no second. Draws casters twice.
    /// Only for maps in a depth format that are not averaged.
    midpoint,
};
[[nodiscard]] GNOMON_API std::string_view nameOf(CasterFaces value);

/// Which triangles of its casters the rasteriser leaves out of a map. This culls all casters, also those that the host
/// calls open or thin. `front` is like CasterFaces::back but makes no exceptions: an open caster loses its shadow or a
/// part of it, and shadows shrink. It is there to show what goes wrong, and for hosts whose art is made for it. A
/// caster is seen from the light, and the winding of a mirrored caster counts the other way round
/// (CasterBatch::mirrored). Goes with CasterFaces::nearest alone.
enum class CasterCull : std::uint8_t {
    none,
    back,  // those that face away from the light: single sheets that are seen from behind cast nothing
    front, // those that face it: a map holds the far side of closed casters, and nothing of lit single sheets
};
[[nodiscard]] GNOMON_API std::string_view nameOf(CasterCull value);

/// `automatic` derives everything from the texel's footprint, the kernel's reach and the receiver's plane, so nothing
/// needs tuning when the map's size, the fit or the kernel changes; the other fields are then ignored.
struct BiasOptions {
    bool automatic = true;       // the other fields are ignored
    float constant_m = 0.0F;     // metres towards the light; any finite value (negative to show what goes wrong)
    float slope = 0.0F;          // times the depth that one texel spans on the receiver; 0 .. 16
    float normal_texels = 0.0F;  // receiver moved along its normal by this many texels' width; 0 .. 16
    bool receiver_plane = false; // each tap is compared with the receiver's plane at that tap

    bool operator==(const BiasOptions&) const = default;
};

} // namespace gnomon
