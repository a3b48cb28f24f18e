// SPDX-License-Identifier: Apache-2.0
// A trapezoid drawn in affine segments, one behind the other along the view.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006, "Trapezoidal Shadow Maps".
//
// A projective warp spends too much of a map on what is near. Affine segments do not: each has texels of one size. In
// pixels these are coarsest at the segment's near end. With a and b the segment's ends along the trapezoid, a texel at
// a is as wide, up to a constant, as
//   e(a, b) = sqrt((b - a) width(b)) / depth(a).
// All segments get the same e; then the largest e is the least that it can be. It is found by bisection: for a given e
// segments are laid one after the other from the near end on, each as long as e lets it be. e fits when the last one
// ends where the trapezoid does.
#pragma once

#include "fit/fit.h"

#include <vector>

namespace gnomon {

struct TsmSegments {
    glm::dvec2 along{0.0, 1.0}; // unit; from near to far. The light's own way up where all is equally far
    std::vector<double> ends;   // ascending dot(along, q), one more than there are segments; none: there is no length
};

/// `count` >= 1 segments of the trapezoid that fitTsm() lays around the outline.
[[nodiscard]] TsmSegments segmentTsm(const FitInput& input, std::uint32_t count);

} // namespace gnomon
