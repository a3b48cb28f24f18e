// SPDX-License-Identifier: Apache-2.0
// A warp that is no stronger than what is seen bears: T. Forsyth, "Extremely Practical Shadows", GDC 2006, says that
// where viewer and light face each other every warp equals the standard map. Published warps go by angles and by the
// ends of what is seen, and may have coarser texels than no warp at all; they are weakened until they have not, so that
// nothing switches, and where nothing is left of one there is none.
#pragma once

#include "fit/view_slope.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

/// A warp's coarsest texel may be so many times as coarse as without it: points tell it no better than that.
inline constexpr double kLoss = 1.01;

/// The same warp with greatest w `strength` > 1 in place of its own. Of parallel light: what stands upright then does
/// so at any strength.
[[nodiscard]] inline Warp ofStrength(const Warp& warp, double own, double strength)
{
    Warp other = warp;
    other.n = warp.n * (own - 1.0) / (strength - 1.0);
    return other;
}

/// The warp, or the strongest weaker one, for which `coarsest_px(warp)` is no more than kLoss times that of none.
template <class Coarsest>
[[nodiscard]] Warp withoutLoss(const FitInput& input, const Warp& warp, const Coarsest& coarsest_px)
{
    Warp none;
    const double most_px = kLoss * coarsest_px(none);
    if (!warp.warped() || coarsest_px(warp) <= most_px) {
        return warp;
    }
    none.outcome = {OutcomeKind::fallback,
                    "with a warp the coarsest texels that are seen would be coarser, so the map is drawn without one"};
    double own = 1.0;
    for (const glm::dvec2& q : input.outline) {
        own = std::max(own, warp.wAt(q));
    }
    constexpr int kTrials = 12;
    constexpr int kHalvings = 8;
    double too_strong = std::log(own);
    const double step = (too_strong - std::log(kLeastStrength)) / kTrials;
    if (!(step > 0.0)) {
        return none;
    }
    const auto bears = [&](double log_strength) {
        return coarsest_px(ofStrength(warp, own, std::exp(log_strength))) <= most_px;
    };
    double borne = too_strong;
    do {
        too_strong = borne;
        borne -= step;
        if (borne < std::log(kLeastStrength) - 0.5 * step) {
            return none;
        }
    } while (!bears(borne));
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (borne + too_strong);
        (bears(middle) ? borne : too_strong) = middle;
    }
    return ofStrength(warp, own, std::exp(borne));
}

} // namespace gnomon
