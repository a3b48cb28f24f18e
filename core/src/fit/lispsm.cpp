// SPDX-License-Identifier: Apache-2.0
// Perspective perpendicular to the light: light stays parallel, and the perspective's strength is free.
// Based on: M. Wimmer, D. Scherzer, W. Purgathofer, "Light Space Perspective Shadow Maps", Eurographics Symposium on
// Rendering 2004.
//
// A texel at w is w^2 times as long along the view, and what is z from the viewer is 1/z as large in the picture. On a
// plane across the rays z grows by the sine of the angle gamma between view and light, so from z_n on
//   w = 1 + (z - z_n) / (n sin gamma),  error ~ w^2 / z.
// Its largest value is least where both ends have the same, w_f^2 / z_f = 1 / z_n, hence
//   n = (z_n + sqrt(z_n z_f)) / sin gamma.   (the paper's n_opt)
// n grows without bound as view and light align: the warp fades into none at all, with nothing to switch.
//
// Departures: z_f is that of what is seen and lit, not the camera's far plane, which may be at infinity; z_n is that of
// the near end of a plane across the rays through what is seen (view_slope.h), not the camera's near plane, where
// nothing is as a rule and which asked for warps far too strong, and no less than a share of z_f for the same reason
// (kLeastShare). A light with a place is warped in the plane of its tangents, where z over the light's depth takes the
// place of z and its slope over the faces of what is seen that of the sine (view_slope.h); the paper asks for its
// post-perspective space, which has the same plane. n is bounded below by what the map can bear (strongestWarp).
#include "fit/view_slope.h"

namespace gnomon {

Warp fitLispsm(const FitInput& input)
{
    const ViewSlope slope = slopeOfView(input);
    Warp warp = warpAlong(input, slope, evenErrorDistance(slope));
    if (warp.warped()) {
        standOnViewer(warp, input);
    }
    return warp;
}

} // namespace gnomon
