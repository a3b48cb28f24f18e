// SPDX-License-Identifier: Apache-2.0
// A warp along the viewer's depth as it is found on what the frustum holds.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006, "What I tried": a simplified LiSPSM, its perspective
// perpendicular to the rays and along the viewer's z. He gives no rule, only its ground: the usual algorithm
// assumes a view without end, and whoever knows what is in the frustum can do with less.
//
// The rule here: fit the viewer's depth over what is seen by a plane, as the light sees it (view_slope.h); its gradient
// is the way of the warp, and its values z_0 and z_1 at the ends of the outline, `length` apart, give
//   n = length sqrt(z_0) / (sqrt(z_1) - sqrt(z_0)) = (z_0 + sqrt(z_0 z_1)) / slope,
// so that a texel is as large in the picture at one end as at the other. No angle between view and light occurs: where
// ground is seen under light that comes from behind the viewer, the depth still grows along it, and so does the warp.
#include "fit/view_slope.h"

namespace gnomon {

Warp fitLispsmSimple(const FitInput& input)
{
    const ViewSlope slope = slopeOfBody(input);
    Warp warp = warpAlong(input, slope, evenErrorDistance(slope));
    if (warp.warped()) {
        standUpright(warp, input.outline);
    }
    return warp;
}

} // namespace gnomon
