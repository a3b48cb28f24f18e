// SPDX-License-Identifier: Apache-2.0
// Fit `auto`: a warp along the viewer's depth over what is seen, as lispsm-simple has it, but as strong as is predicted
// to err least.
#pragma once

#include "auto/map_error.h"
#include "fit/view_slope.h"

#include <span>

namespace gnomon {

/// One frustum of which the strength of its warp is to be found.
struct WarpTrial {
    const FitInput& fit;
    ViewSlope slope; // slopeOfBody()
    LightRect unwarped;
    double least_size = 0.0; // as frameOf() has it
    std::uint32_t map_size = 0;
    double border_texels = 0.0;
    std::span<const LitPoint> points;
    /// For quality best: the outline of the points and of the room for their rays, around which the GPU will fit the
    /// map. Else empty: the map covers the whole outline.
    std::span<const glm::dvec2> places;
    double feature_m = 0.0;
    double finest_px = kFineEnough_px; // as mapErrorOf() has it

    /// A strength is the greatest w of the outline; 1: no warp.
    [[nodiscard]] MapError errorAt(double strength) const;
};

/// The warp of a strength; none where it would be weaker than kLeastStrength, or where there is no slope. That is as
/// good a choice as any, and no fallback.
[[nodiscard]] Warp warpOfStrength(const FitInput& input, const ViewSlope& slope, double strength);

/// The strength to draw by. `before`: that of the frame before, 0: there was none. A strength stays while the best one
/// errs hardly less, goes towards the best one by a twentieth of the way, which is 1 to 3 % of the strength, and is
/// left at once where it errs much more, as after a cut. Depends on its arguments alone.
[[nodiscard]] double nextStrength(const WarpTrial& trial, double before);

} // namespace gnomon
