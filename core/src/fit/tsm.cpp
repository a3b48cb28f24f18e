// SPDX-License-Identifier: Apache-2.0
// A trapezoid about the viewer's centre line, drawn as the square of the map.
// Based on: T. Martin, T.-S. Tan, "Anti-aliasing and Continuity with Trapezoidal Shadow Maps", Eurographics Symposium
// on Rendering 2004.
//
// Top and base line lie across the centre line and touch the outline, lambda apart; the sides meet where the centre
// line meets the vanishing line, n (the paper's eta) behind the top line, and touch the outline too: that is the
// rectangle around what Warp makes of it. n puts the end of the focus region, delta from the top line, at xi = -0.6 of
// a map from 1 (top) to -1 (base), so that the region has 80 % of the map:
//   n = lambda delta (1 + xi) / (lambda - 2 delta - lambda xi).   (the paper's eq. for eta)
//
// Departures: the paper leaves the focus distance to the user. Here it lies at z_n^0.2 z_f^0.8, with z_n the least
// depth of view and z_f the one at the base line, on a plane across the rays (as in lispsm.cpp): a picture shows the
// depth of a ground evenly on a logarithmic scale, and 80 % of that scale get 80 % of the map. So delta / lambda
// depends on z_f / z_n alone and is less than 0.8: where view and light align, or all is about equally far, it comes
// close to 0.8, n grows without bound and the warp fades into none, where the paper's trapezoid changes its shape at
// once. With a z_f of its own, as lispsm has it, delta and lambda would change apart, and n with their difference,
// several times as fast. z_n fades into kSoftShare of z_f, below which it does not fall: where what is seen reaches to
// the eye, n would follow the last decimetres before it, and texels change by half their size from frame to frame.
#include "fit/view_slope.h"

#include <limits>

namespace gnomon {
namespace {

constexpr double kFocusShare = 0.8;
constexpr double kFocusLine = 1.0 - 2.0 * kFocusShare; // xi
constexpr double kSoftShare = 1.0 / 1000.0;

} // namespace

Warp fitTsm(const FitInput& input)
{
    const ViewSlope slope = slopeOfView(input);
    const double lambda = slope.length;
    const double low = std::hypot(slope.low, kSoftShare * (slope.low + slope.slope * lambda));
    const double base = low + slope.slope * lambda; // both contain the same addend: where all points are equally far,
                                                    // even a millionth in their ratio would be a strong warp
    const double focus = std::pow(low, 1.0 - kFocusShare) * std::pow(base, kFocusShare);
    const double delta = (focus - low) / slope.slope;
    const double rest = lambda - 2.0 * delta - lambda * kFocusLine;
    const double n = rest > 0.0 ? lambda * delta * (1.0 + kFocusLine) / rest : std::numeric_limits<double>::infinity();
    Warp warp = warpAlong(input, slope, n);
    if (warp.warped()) {
        standOnViewer(warp, input);
    }
    return warp;
}

} // namespace gnomon
