// SPDX-License-Identifier: Apache-2.0
// How the viewer's depth grows across the light: what every fit that warps along the view asks first.
#pragma once

#include "fit/fit.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

/// The plane across the light, with a value on it that says how small things are in the picture: the viewer's depth,
/// divided by the light's depth where the light has a place. One step dq of the plane is dq metres across the rays, or
/// dq times the light's depth; so in the picture it is dq / value long, up to a constant. On any plane of the world the
/// value is affine in q: both depths are affine in the point, and the reciprocal of the light's is affine in q.
struct ViewSlope {
    glm::dvec2 along{0.0, 1.0}; // unit; the way in which the value grows
    double slope = 0.0;         // by so much per step, >= 0; 0: nowhere, and `along` means nothing
    double low = 0.0;      // at the near end of the outline, >= 0: on the plane of this slope that lies evenly through
                           // what is seen. Not the least of all: the body has the viewer in it where a box of the
                           // scene has, and would reach to the camera's near plane with nothing there to see
    double high = 0.0;     // and at the far end
    double length = 0.0;   // length of the outline, along `along`
    double nearest = 0.0;  // least dot(along, q) of the outline
    std::string_view weak; // the reason where a warp by this slope is too weak to matter
    Outcome outcome;       // fallback: there is nothing to go by, and the reason says why
};

/// On planes that lie across the rays. Directional lights: the slope is the sine of the angle between view and light,
/// the value is the depth along the view, and `high` is the greatest of all that is seen.
[[nodiscard]] ViewSlope slopeAcrossLight(const FitInput& input);

/// The slope of the seen body: least squares over its faces, as the light sees them. `low` and `high` are at the ends
/// of the outline, limited by the values at its corners.
[[nodiscard]] ViewSlope slopeOfBody(const FitInput& input);

/// slopeAcrossLight() where there is one axis of light, slopeOfBody() where there is not.
[[nodiscard]] ViewSlope slopeOfView(const FitInput& input);

/// Points nearer to the viewer than this share of the farthest do not affect a warp by even errors, which is therefore
/// never stronger than 20. The body of possibly seen points often reaches to the eye, because some box does, with
/// nothing there. The two errors to make equal would then be those of air and of the horizon, and all between would get
/// too few texels. Among 0, 1/500, 1/250, 1/125 and 1/62 the second and third gave the highest least density on a
/// meadow, a battlefield and a town (`tools/measure_fits.py --tables density`).
inline constexpr double kLeastShare = 1.0 / 400.0;

/// How far the vanishing line lies behind the nearest point where both ends have the same error: n of LiSPSM (Wimmer et
/// al. 2004). Infinite where there is no slope.
[[nodiscard]] inline double evenErrorDistance(const ViewSlope& slope)
{
    const double low = std::max(slope.low, kLeastShare * slope.high);
    return (low + std::sqrt(low * slope.high)) / slope.slope;
}

/// The warp along the slope with the vanishing line `n` behind the nearest point; infinite: no warp is wanted. A warp
/// that is too strong for the map is weakened; one that is too weak to matter is a fallback.
[[nodiscard]] Warp warpAlong(const FitInput& input, const ViewSlope& slope, double n);

/// Warps weaker than this are not worth leaving the light's own axes.
inline constexpr double kLeastStrength = 1.01;

/// Stands the image of the outline upright: of all shears the one that leaves x and y uncorrelated over its area. The
/// outline of a symmetric view is cut by the viewer's own line then, and no other has less to lose.
void standUpright(Warp& warp, std::span<const glm::dvec2> outline);
/// The line upright that the viewer is on. A light with a place may have the viewer beside or behind it, where it casts
/// no image of him: standUpright() then.
void standOnViewer(Warp& warp, const FitInput& input);

} // namespace gnomon
