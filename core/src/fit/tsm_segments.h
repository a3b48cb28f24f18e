// SPDX-License-Identifier: Apache-2.0
// A trapezoid drawn in affine pieces, one behind the other along the view.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006, "Trapezoidal Shadow Maps".
//
// A projective warp spends too much of a map on what is near. Pieces that are affine each do not, and an affine map
// has texels of one size. Texels of a piece are coarsest, in pixels, at its near end. With a and b its ends along the
// trapezoid, its texels there are in proportion to
//   e(a, b) = sqrt((b - a) width(b)) / depth(a).
// The ends are those at which e is the same of all pieces, and so the largest of them the least that it can be. They
// are found iteratively: for an e the pieces are laid one after the other from the near end on, each as long as e lets
// it be, and e is halved in until the last one ends where the trapezoid does.
#pragma once

#include "fit/fit.h"

#include <vector>

namespace gnomon {

struct TsmSegments {
    glm::dvec2 along{0.0, 1.0}; // unit; from near to far across the light. The light's own way up where nothing is near
    std::vector<double> ends;   // ascending dot(along, q), one more than there are pieces; none: there is no length
};

/// `count` >= 1 pieces of what fitTsm() lays around the outline.
[[nodiscard]] TsmSegments segmentTsm(const FitInput& input, std::uint32_t count);

} // namespace gnomon
