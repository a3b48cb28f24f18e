// SPDX-License-Identifier: Apache-2.0
// The search: J. Kiefer, "Sequential minimax search for a maximum", 1953 (golden section), around the best of a few
// strengths, because the error may have more than one minimum.
#include "auto/warp_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon {
namespace {

/// The strengths that are tried first begin with kFirst. Each is kRatio times the one before.
constexpr double kFirst = 1.25;
constexpr double kRatio = 1.7;
constexpr int kSections = 6;
/// A warp turns the map off the light's own axes and makes its texels move more, so it has to be better than none by so
/// much.
constexpr double kWarpGain = 0.97;
/// Beside the best one's error: a strength that errs less stays, and one that errs more is left at once.
constexpr double kAsGood = 1.02;
constexpr double kFarWorse = 1.5;
/// From frame to frame: the least and the largest step of the logarithm of a strength, and its share of the way that is
/// left.
constexpr double kStep = 0.01;
constexpr double kMostStep = 0.0295; // 3 %
constexpr double kShareOfWay = 0.05;

struct Tried {
    double log_strength = 0.0;
    double error = 0.0;
};

Tried tryAt(const WarpTrial& trial, double log_strength)
{
    return {log_strength, trial.errorAt(std::exp(log_strength)).mean()};
}

Tried goldenSection(const WarpTrial& trial, double low, double high)
{
    constexpr double kShare = 1.0 / std::numbers::phi;
    Tried a = tryAt(trial, high - kShare * (high - low));
    Tried b = tryAt(trial, low + kShare * (high - low));
    for (int i = 0; i < kSections; ++i) {
        if (a.error <= b.error) {
            high = b.log_strength;
            b = a;
            a = tryAt(trial, high - kShare * (high - low));
        } else {
            low = a.log_strength;
            a = b;
            b = tryAt(trial, low + kShare * (high - low));
        }
    }
    return a.error <= b.error ? a : b;
}

/// The best of the warps. No warp at all is not among them.
Tried bestWarp(const WarpTrial& trial)
{
    const double last = std::log(std::max(kFirst, trial.fit.strongest));
    Tried best = tryAt(trial, std::log(kFirst));
    for (double at = std::log(kFirst) + std::log(kRatio); at < last; at += std::log(kRatio)) {
        const Tried found = tryAt(trial, at);
        if (found.error < best.error) {
            best = found;
        } else if (found.error > 2.0 * best.error) {
            break; // stronger ones are worse still
        }
    }
    const Tried finer = goldenSection(trial, std::max(best.log_strength - std::log(kRatio), std::log(kLeastStrength)),
                                      std::min(best.log_strength + std::log(kRatio), last));
    return finer.error < best.error ? finer : best;
}

} // namespace

MapError WarpTrial::errorAt(double strength) const
{
    const Warp warp = warpOfStrength(fit, slope, strength);
    const LightRect rect = !places.empty() ? rectOf(warp, places)
                           : warp.warped() ? rectOf(warp, fit.outline)
                                           : unwarped;
    return mapErrorOf(points, warp, frameOf(rect, least_size, map_size, border_texels), feature_m, finest_px);
}

Warp warpOfStrength(const FitInput& input, const ViewSlope& slope, double strength)
{
    if (!(strength >= kLeastStrength) || slope.outcome.kind != OutcomeKind::ok) {
        return {};
    }
    Warp warp = warpAlong(input, slope, slope.length / (strength - 1.0));
    if (!warp.warped()) {
        return {};
    }
    standUpright(warp, input.outline);
    return warp;
}

double nextStrength(const WarpTrial& trial, double before)
{
    if (trial.slope.outcome.kind != OutcomeKind::ok || trial.points.empty()) {
        return before > 0.0 ? before : 1.0;
    }
    const Tried flat = tryAt(trial, 0.0);
    Tried best = bestWarp(trial);
    if (best.error > kWarpGain * flat.error) {
        best = flat;
    }
    if (!(before > 0.0)) {
        return std::exp(best.log_strength);
    }
    const Tried now = tryAt(trial, std::log(before));
    if (now.error <= kAsGood * best.error) {
        return before;
    }
    if (now.error > kFarWorse * best.error) {
        return std::exp(best.log_strength);
    }
    const double way = best.log_strength - now.log_strength;
    const double most = std::clamp(kShareOfWay * std::abs(way), kStep, kMostStep);
    return std::exp(now.log_strength + std::clamp(way, -most, most));
}

} // namespace gnomon
