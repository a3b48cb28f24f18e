// SPDX-License-Identifier: Apache-2.0
// A warp that is no stronger than what is seen bears: T. Forsyth, "Extremely Practical Shadows", GDC 2006, says that
// where viewer and light face each other every warp equals the standard map. Published warps go by angles and by the
// ends of what is seen, and may have coarser texels than no warp at all; they fade to none where they do.
#pragma once

#include "fit/view_slope.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

/// The coarsest texel counts against a warp from kLossBegins times its width without the warp, since points tell the
/// width no better than by a hundredth. From there the warp fades, and at kLossEnds times nothing of it is left.
inline constexpr double kLossBegins = 1.01;
inline constexpr double kLossEnds = 1.4;
/// A warp whose finest texels have kWorth times the density of the map without it is drawn as it is. One that has no
/// more density than the map without it has nothing to give.
inline constexpr double kWorth = 2.0;

/// A warp with the greatest w changed from `own` to `strength` > 1. For parallel light: upright things stay upright at
/// any strength.
[[nodiscard]] inline Warp ofStrength(const Warp& warp, double own, double strength)
{
    Warp other = warp;
    other.n = warp.n * (own - 1.0) / (strength - 1.0);
    return other;
}

/// The share of a warp's strength (its logarithm) that is kept. The warp gives the finest texels `gain` times the
/// density, and makes the coarsest ones that are seen `loss` times as wide. It fades, so that nothing switches.
[[nodiscard]] inline double shareOfWarp(double gain, double loss)
{
    const double by_gain = std::log(std::max(gain, 1.0)) / std::log(kWorth);
    const double by_loss = (kLossEnds - loss) / (kLossEnds - kLossBegins);
    return std::clamp(std::min(by_gain, by_loss), 0.0, 1.0);
}

/// The warp, as strong as that leaves it: hardly a warp any more where it loses, and none where it gains nothing.
[[nodiscard]] inline Warp weakened(const FitInput& input, const Warp& warp, double gain, double loss)
{
    const double share = shareOfWarp(gain, loss);
    if (!warp.warped() || share == 1.0) {
        return warp;
    }
    if (gain <= 1.0) {
        Warp none;
        none.outcome = {OutcomeKind::fallback, "with a warp texels would be larger all over, because view and light "
                                               "leave it little to do, so the map is drawn without one"};
        return none;
    }
    double own = 1.0;
    for (const glm::dvec2& q : input.outline) {
        own = std::max(own, warp.wAt(q));
    }
    const double strength = std::max(std::pow(own, share), kLeastStrength);
    return strength < own ? ofStrength(warp, own, strength) : warp;
}

} // namespace gnomon
