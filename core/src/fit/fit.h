// SPDX-License-Identifier: Apache-2.0
// How one frustum's projection is shaped. A fit is one file, and its declaration and row here.
//
// Whatever a projection does, a texel of a light's map is one ray of that light. So every map is an image of the plane
// across the light, whose points are the rays; and two perspective images of one plane differ by a homography. That
// holds for all published warps, PSM in its post-perspective space included. Up to what the rectangle of the map makes
// good anyway (where it is, how wide and how high), a homography is told by three numbers: the way in which texels
// grow, where the line lies on which they would be infinite (the vanishing line, w = 0), and which of the lines along
// that way stays upright. A fit gives these; projection.h makes the map of them. Depth is none of a fit's business: a
// map stores metres along the rays, whatever the projection does to z.
#pragma once

#include "camera_view.h"
#include "light_space.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace gnomon {

struct FitInput {
    const LightSpace& space;
    /// The outline of what is seen and lit, which has to be in the map: as seen from the light, convex,
    /// counter-clockwise, one point at least, as in LightRect;
    std::span<const glm::dvec2> outline;
    /// and in the world, the corners of its faces, face after face, and how many each has.
    std::span<const glm::dvec3> body_ws;
    std::span<const std::uint32_t> face_sizes;
    const CameraView& view;
    double strongest = 1000.0; // greatest w that the outline may get, > 1: strongestWarp() in projection.h
};

/// A homography of the plane across the light. With q a point of that plane as LightRect has it, s = dot(along, q) and
/// b = dot(across(), q), a point of the map, before it is scaled and moved, is
///   w = 1 + (s - nearest) / n,  x = (b - upright) / w,  y = (s - nearest) / w:
/// a texel at w is w times as wide and w^2 times as long as one at w = 1.
struct Warp {
    glm::dvec2 along{0.0, 1.0}; // unit; the way from where texels are fine to where they are coarse
    double nearest = 0.0;       // least s of the outline; there w is 1
    double upright = 0.0;       // lines along `along` turn by the warp, all but the one at this b
    double n = 0.0;             // how far behind `nearest` the vanishing line lies, > 0; 0: no warp, w = 1 everywhere
    Outcome outcome;            // ok, or fallback: then there is no warp, and the reason says why

    [[nodiscard]] bool warped() const { return n > 0.0; }
    [[nodiscard]] glm::dvec2 across() const { return {along.y, -along.x}; }
    [[nodiscard]] double wAt(const glm::dvec2& q) const
    {
        return warped() ? 1.0 + (glm::dot(along, q) - nearest) / n : 1.0;
    }
};
using FitFunction = Warp (*)(const FitInput& input);

Warp fitUniform(const FitInput& input);
Warp fitLispsm(const FitInput& input);
Warp fitLispsmSimple(const FitInput& input);
Warp fitTsm(const FitInput& input);
Warp fitPsm(const FitInput& input);
Warp fitScene(const FitInput& input);

struct FitRow {
    Fit fit;
    FitFunction function;
};
inline constexpr FitRow kFits[] = {
    {Fit::uniform, fitUniform}, {Fit::lispsm, fitLispsm}, {Fit::lispsm_simple, fitLispsmSimple},
    {Fit::tsm, fitTsm},         {Fit::psm, fitPsm},       {Fit::scene, fitScene},
};

/// Null for what is not a fit.
[[nodiscard]] constexpr FitFunction fitFunction(Fit fit)
{
    const auto* const row = std::ranges::find(kFits, fit, &FitRow::fit);
    return row != std::end(kFits) ? row->function : nullptr;
}

} // namespace gnomon
